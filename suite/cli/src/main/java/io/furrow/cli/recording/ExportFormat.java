package io.furrow.cli.recording;

import java.io.IOException;
import java.io.OutputStream;
import java.util.List;
import java.util.Locale;
import java.util.Optional;
import java.util.function.LongConsumer;

import org.apache.flink.core.fs.Path;

import io.furrow.mission.Recording;
import io.furrow.mission.archive.MissionFiles;
import io.furrow.mission.export.ExportResult;
import io.furrow.mission.export.GeoJsonExport;
import io.furrow.mission.export.McapExport;
import io.furrow.mission.export.MissionExport;
import io.furrow.mission.marker.Marker;
import io.furrow.mission.marker.MarkerFile;

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

    /** As it is written on the command line. */
    @Override
    public String toString() {
        return name().toLowerCase(Locale.ROOT);
    }

    /** @throws IOException if it cannot be read or written */
    public ExportResult write(MissionStore store, String mission, OutputStream out, LongConsumer progress)
            throws IOException {
        if (export == null) {
            return new ExportResult(store.export(mission, out, progress), 0, Optional.empty());
        }
        try (Recording recording = store.open(mission)) {
            return export.write(new MissionExport.Source(mission, recording, store.markers(mission)), out, progress);
        }
    }

    /**
     * Writes the markers of a mission beside its file if the format cannot hold them.
     *
     * @param file of the mission
     * @return the file of the markers; empty without markers, or if the mission's file holds them
     */
    public Optional<Path> writeMarkers(MissionStore store, String mission, Path file) throws IOException {
        if (export != null) {
            return Optional.empty();
        }
        Path beside = new Path(MarkerFile.beside(file.toString()));
        List<Marker> markers = store.markers(mission);
        if (markers.isEmpty() && !beside.getFileSystem().exists(beside)) {
            return Optional.empty();
        }
        MissionFiles.write(beside, out -> {
            MarkerFile.write(markers, out);
            return markers.size();
        });
        return Optional.of(beside);
    }
}
