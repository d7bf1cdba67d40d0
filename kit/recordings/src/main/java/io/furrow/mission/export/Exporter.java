package io.furrow.mission.export;

import java.io.IOException;
import java.util.Optional;
import java.util.function.LongConsumer;

import io.furrow.mission.Cursor;
import io.furrow.mission.EventPage;
import io.furrow.mission.PageLimits;
import io.furrow.mission.Recording;
import io.furrow.mission.SkippedRecords;
import io.furrow.mission.StoredEvent;

/** Writes every event of a recording in a format and counts the written and skipped ones. */
final class Exporter {
    private static final int PROGRESS_EVERY = 10_000;

    private final LongConsumer progress;
    private long events;
    private long skipped;
    private String example;

    /** Writes an event in a format. */
    interface Step {
        /** Returns why the format cannot express the event; empty if it was written. */
        Optional<String> write(StoredEvent event) throws IOException;
    }

    Exporter(LongConsumer progress) {
        this.progress = progress;
    }

    ExportResult over(Recording recording, Step step) throws IOException {
        Cursor next = Cursor.START;
        boolean last = false;
        while (!last) {
            EventPage eventPage = recording.read(next, PageLimits.DEFAULT);
            for (SkippedRecords skippedRecords : eventPage.skipped()) {
                skip(skippedRecords.what(), skippedRecords.reason(), skippedRecords.count());
            }
            for (StoredEvent event : eventPage.events()) {
                write(event, step);
            }
            next = eventPage.next();
            last = eventPage.last();
        }
        return new ExportResult(events, skipped, Optional.ofNullable(example));
    }

    private void write(StoredEvent event, Step step) throws IOException {
        Optional<String> problem = step.write(event);
        if (problem.isPresent()) {
            skip("event " + event.id(), problem.get(), 1);
        } else if (++events % PROGRESS_EVERY == 0) {
            progress.accept(events);
        }
    }

    private void skip(String what, String reason, long count) {
        skipped += count;
        example = example == null ? what + ": " + reason : example;
    }
}
