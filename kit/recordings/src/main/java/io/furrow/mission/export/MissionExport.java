package io.furrow.mission.export;

import java.io.IOException;
import java.io.OutputStream;
import java.util.List;
import java.util.function.LongConsumer;

import io.furrow.mission.Recording;
import io.furrow.mission.marker.Marker;

/** Exports a mission in a format of other tools. The same events and markers always produce the same bytes. */
public interface MissionExport {
    /**
     * A mission to export.
     *
     * @param name for the export
     * @param markers in the order of their times
     */
    record Source(String name, Recording recording, List<Marker> markers) {}

    /**
     * Writes all of a mission; the stream stays open.
     *
     * @param progress called at intervals with the number of events so far
     */
    ExportResult write(Source mission, OutputStream out, LongConsumer progress) throws IOException;
}
