package io.furrow.mission.topic;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Optional;
import java.util.stream.Stream;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.mission.Cursor;
import io.furrow.mission.EventPage;
import io.furrow.mission.PageLimits;
import io.furrow.mission.Recording;
import io.furrow.mission.RecordingException;
import io.furrow.mission.RecordingExtent;
import io.furrow.mission.SkippedRecords;

/**
 * The sorted events of a topic in a temporary file, which is deleted on close.
 *
 * @param lines of the file
 * @param folder of the file
 * @param skipped records of the topic that are not events
 */
record TopicRecording(Recording lines, Path folder, List<SkippedRecords> skipped) implements Recording {
    private static final Logger LOG = LoggerFactory.getLogger(TopicRecording.class);

    @Override
    public Optional<RecordingExtent> span() throws RecordingException {
        return lines.span();
    }

    @Override
    public EventPage read(Cursor after, PageLimits limits) throws RecordingException {
        EventPage eventPage = lines.read(after, limits);
        if (!after.equals(Cursor.START) || skipped.isEmpty()) {
            return eventPage;
        }
        List<SkippedRecords> all = new ArrayList<>(skipped);
        all.addAll(eventPage.skipped());
        return new EventPage(eventPage.events(), all, eventPage.next(), eventPage.last());
    }

    @Override
    public void close() {
        lines.close();
        delete(folder);
    }

    /** Deletes a folder and its files if it exists. */
    static void delete(Path folder) {
        if (!Files.exists(folder)) {
            return;
        }
        try (Stream<Path> found = Files.walk(folder)) {
            for (Path path : found.sorted(Comparator.reverseOrder()).toList()) {
                Files.deleteIfExists(path);
            }
        } catch (IOException e) {
            LOG.warn("The temporary folder {} cannot be deleted; delete it", folder, e);
        }
    }
}
