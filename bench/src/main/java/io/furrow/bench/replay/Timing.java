package io.furrow.bench.replay;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Optional;

import io.furrow.bench.replay.Lateness.Late;

/**
 * The punctuality of the events of one turn.
 *
 * @param start lateness at the broker in the first seconds of each replay; empty if these are not separated
 * @param steady at the broker, after these
 * @param handedOver to the producer, after these
 * @param missing events that are not on the topic
 */
record Timing(Optional<Lateness> start, Lateness steady, Lateness handedOver, long missing) {
    /** Collects the events of several replays. */
    static final class Collected {
        private final long startMillis;
        private final List<Late> start = new ArrayList<>();
        private final List<Late> steady = new ArrayList<>();
        private final List<Late> handedOver = new ArrayList<>();
        private long missing;

        /** @param startMillis initial time of each replay that is separated; 0 for none */
        Collected(long startMillis) {
            this.startMillis = startMillis;
        }

        void add(ScheduledReplay replay, List<PlayedRecord> events, long expected) {
            missing += expected - events.size();
            for (PlayedRecord event : events) {
                long due = replay.due(event.time());
                if (due - replay.anchor() < startMillis) {
                    start.add(new Late(due, event.appended()));
                } else {
                    steady.add(new Late(due, event.appended()));
                    handedOver.add(new Late(due, event.handedOver()));
                }
            }
        }

        Timing timing() {
            return new Timing(
                    start.isEmpty() ? Optional.empty() : Optional.of(lateness(start)),
                    lateness(steady),
                    lateness(handedOver),
                    missing);
        }

        private static Lateness lateness(List<Late> events) {
            events.sort(Comparator.comparingLong(Late::due));
            return Lateness.of(events);
        }
    }
}
