package io.furrow.cli.recording;

import java.io.IOException;
import java.io.OutputStream;
import java.util.List;
import java.util.function.LongConsumer;

import org.apache.flink.core.fs.Path;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ListLimit;
import io.furrow.mission.Recording;
import io.furrow.mission.archive.MissionArchive;
import io.furrow.mission.archive.MissionFiles;
import io.furrow.mission.marker.Marker;

/** Stored missions, as the control plane serves them or in MongoDB itself. */
public interface MissionStore extends MissionFiles.Importer, AutoCloseable {
    /** Lists {@code mission}, {@code events}, {@code first} and {@code last} of each. */
    ControlApi.Page list(ListLimit limit);

    /** Writes the events of a mission as lines, in the order of their times. @return number of events */
    long export(String mission, OutputStream out, LongConsumer progress) throws IOException;

    /** Opens a mission; the recording is to be closed before the store. */
    Recording open(String mission) throws IOException;

    /** Returns the folder of a mission in an archive. */
    Path folder(String mission, Path root);

    /** Adds the missing events of a mission to an archive. */
    MissionArchive.Outcome archive(String mission, Path root) throws IOException;

    /** Returns the markers of a mission in the order of their times. */
    List<Marker> markers(String mission) throws IOException;

    @Override
    void close() throws IOException;
}
