package io.furrow.launcher;

import java.io.IOException;
import java.io.OutputStream;
import java.util.Optional;
import java.util.function.LongConsumer;

import io.furrow.ingest.mission.StoredMissions;
import io.furrow.mission.MongoAccess;
import io.furrow.mission.MongoRecordings;
import io.furrow.mission.Recording;
import io.furrow.mission.RecordingGoneException;
import io.furrow.mission.export.Exported;
import io.furrow.mission.export.GeoJsonExport;
import io.furrow.mission.export.McapExport;
import io.furrow.mission.export.MissionExport;

/** What {@code ./furrow mission export} writes. */
enum ExportFormat {
    JSONL(null),
    MCAP(new McapExport()),
    GEOJSON(new GeoJsonExport());

    /** Null for the lines that can be imported again. */
    private final MissionExport export;

    ExportFormat(MissionExport export) {
        this.export = export;
    }

    /**
     * A mission in MongoDB.
     *
     * @param missions where it is known
     */
    record Source(StoredMissions missions, String mongo, String mission) {}

    Exported write(Source source, OutputStream out, LongConsumer progress) throws IOException {
        if (export == null) {
            return new Exported(source.missions().export(source.mission(), out, progress), 0, Optional.empty());
        }
        MongoRecordings recordings = new MongoRecordings(source.mongo(), MongoAccess.DATABASE);
        try (Recording recording = recordings
                .open(source.mission())
                .orElseThrow(() ->
                        new RecordingGoneException("Mission %s has just been deleted".formatted(source.mission())))) {
            return export.write(source.mission(), recording, out, progress);
        }
    }
}
