package io.furrow.ingest.image;

import java.util.concurrent.Future;

import org.apache.flink.util.function.ThrowingRunnable;

import io.furrow.ingest.route.ReportedEvent;

/** An event that waits for the store, or a watermark that waits for the events before it. */
final class InFlightEvent {
    private ReportedEvent event;
    private final ThrowingRunnable<Exception> mark;
    private Future<?> deadline;
    private boolean passed;

    private InFlightEvent(ReportedEvent event, ThrowingRunnable<Exception> mark, boolean passed) {
        this.event = event;
        this.mark = mark;
        this.passed = passed;
    }

    static InFlightEvent event(ReportedEvent event) {
        return new InFlightEvent(event, () -> {}, false);
    }

    /** @param mark the action after everything before it was emitted */
    static InFlightEvent mark(ThrowingRunnable<Exception> mark) {
        return new InFlightEvent(null, mark, true);
    }

    /** Null once it has been emitted: an event queued after another entity's image must not hold its own in memory. */
    ReportedEvent event() {
        return event;
    }

    void until(Future<?> timer) {
        deadline = timer;
    }

    void pass() {
        passed = true;
        event = null;
        if (deadline != null) {
            deadline.cancel(false);
        }
    }

    boolean hasPassed() {
        return passed;
    }

    void emitMark() throws Exception {
        mark.run();
    }
}
