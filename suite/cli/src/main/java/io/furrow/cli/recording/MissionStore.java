package io.furrow.cli.recording;

import java.io.IOException;
import java.io.OutputStream;
import java.util.List;
import java.util.function.LongConsumer;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.mission.Recording;
import io.furrow.mission.archive.MissionFiles;
import io.furrow.mission.marker.Marker;

/** Stored missions, as the control plane serves them or in MongoDB itself. */
public interface MissionStore extends MissionFiles.Importer, AutoCloseable {
    /** Lists {@code mission}, {@code first} and {@code last} of each, and {@code events} where that is known. */
    JsonNode list();

    /** Writes the events of a mission as lines, in the order of their times. @return number of events */
    long export(String mission, OutputStream out, LongConsumer progress) throws IOException;

    /** Opens a mission; the recording is to be closed before the store. */
    Recording open(String mission) throws IOException;

    /** Returns the markers of a mission in the order of their times. */
    List<Marker> markers(String mission) throws IOException;

    @Override
    void close() throws IOException;
}
