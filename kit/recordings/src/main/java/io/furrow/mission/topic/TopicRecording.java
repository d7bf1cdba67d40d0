package io.furrow.mission.topic;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;

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
record TopicRecording(Recording lines, TemporaryFolder folder, List<SkippedRecords> skipped) implements Recording {
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
        folder.close();
    }
}
