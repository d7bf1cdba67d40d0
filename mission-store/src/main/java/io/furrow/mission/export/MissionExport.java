package io.furrow.mission.export;

import java.io.IOException;
import java.io.OutputStream;
import java.util.function.LongConsumer;

import io.furrow.mission.Recording;

/** Writes a recording in a format of other tools. The same events are always the same bytes. */
public interface MissionExport {
    /**
     * Writes all of a recording; the stream stays open.
     *
     * @param mission its name
     * @param progress takes the number of events so far now and then
     */
    Exported write(String mission, Recording recording, OutputStream out, LongConsumer progress) throws IOException;
}
