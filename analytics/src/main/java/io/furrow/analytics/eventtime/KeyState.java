package io.furrow.analytics.eventtime;

import java.util.ArrayList;
import java.util.List;

/**
 * The messages of a key that wait for the watermark, and its state. Changed in place.
 *
 * @param <M> the messages
 * @param <S> the state
 */
public class KeyState<M extends HasEventTime, S> {
    List<M> waiting = new ArrayList<>(1);
    S remembered;

    KeyState() {}

    final void takeOver(KeyState<M, S> other) {
        waiting = other.waiting;
        remembered = other.remembered;
    }

    /** Moves the messages that the watermark has passed to {@code due}, unordered. */
    final void takeDue(long watermark, List<M> due) {
        int left = 0;
        for (int i = 0; i < waiting.size(); i++) {
            M message = waiting.get(i);
            if (message.time() <= watermark) {
                due.add(message);
            } else {
                waiting.set(left++, message);
            }
        }
        waiting.subList(left, waiting.size()).clear();
    }

    /** The earliest time of its messages, of which there is at least one. */
    final long earliest() {
        long earliest = Long.MAX_VALUE;
        for (M message : waiting) {
            earliest = Math.min(earliest, message.time());
        }
        return earliest;
    }

    final boolean isEmpty() {
        return remembered == null && waiting.isEmpty();
    }
}
