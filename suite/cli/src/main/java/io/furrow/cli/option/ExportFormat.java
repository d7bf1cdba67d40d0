package io.furrow.cli.option;

import java.io.IOException;
import java.io.OutputStream;
import java.util.List;
import java.util.Locale;
import java.util.Optional;
import java.util.function.LongConsumer;

import org.apache.flink.core.fs.Path;

import io.furrow.mission.Recording;
import io.furrow.mission.RecordingDeletedException;
import io.furrow.mission.archive.MissionFiles;
import io.furrow.mission.archive.StoredMissions;
import io.furrow.mission.export.ExportResult;
import io.furrow.mission.export.GeoJsonExport;
import io.furrow.mission.export.McapExport;
import io.furrow.mission.export.MissionExport;
import io.furrow.mission.marker.Marker;
import io.furrow.mission.marker.MarkerFile;
import io.furrow.mission.marker.Markers;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.MongoRecordings;

/** The output formats of {@code ./furrow mission export}. */
public enum ExportFormat {
    JSONL(null),
    MCAP(new McapExport()),
    GEOJSON(new GeoJsonExport());

    /** Null for lines that can be imported again. */
    private final MissionExport export;

    ExportFormat(MissionExport export) {
        this.export = export;
    }

    /**
     * A mission in MongoDB.
     *
     * @param missions its store
     */
    public record Source(StoredMissions missions, String mongo, String mission) {}

    /** As it is written on the command line. */
    @Override
    public String toString() {
        return name().toLowerCase(Locale.ROOT);
    }

    public ExportResult write(Source source, OutputStream out, LongConsumer progress) throws IOException {
        if (export == null) {
            return new ExportResult(source.missions().export(source.mission(), out, progress), 0, Optional.empty());
        }
        MongoRecordings recordings = new MongoRecordings(source.mongo(), MongoAccess.DATABASE);
        try (Recording recording = recordings
                .open(source.mission())
                .orElseThrow(() -> new RecordingDeletedException(
                        "Mission %s has just been deleted".formatted(source.mission())))) {
            MissionExport.Source mission = new MissionExport.Source(source.mission(), recording, markers(source));
            return export.write(mission, out, progress);
        }
    }

    /**
     * Writes the markers of a mission beside its file if the format cannot hold them.
     *
     * @param file of the mission
     * @return the file of the markers; empty without markers, or if the mission's file holds them
     */
    public Optional<Path> writeMarkers(Source source, Path file) throws IOException {
        if (export != null) {
            return Optional.empty();
        }
        Path beside = new Path(MarkerFile.beside(file.toString()));
        List<Marker> markers = markers(source);
        if (markers.isEmpty() && !beside.getFileSystem().exists(beside)) {
            return Optional.empty();
        }
        MissionFiles.write(beside, out -> {
            MarkerFile.write(markers, out);
            return markers.size();
        });
        return Optional.of(beside);
    }

    private static List<Marker> markers(Source source) throws IOException {
        try (Markers markers = Markers.open(source.mongo(), MongoAccess.DATABASE)) {
            return markers.list(source.mission());
        }
    }
}
