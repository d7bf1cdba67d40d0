package io.furrow.analytics.eventtime;

import java.util.ArrayList;
import java.util.List;

/**
 * All that a key has: messages that wait for the watermark, and what is remembered. Changed in place.
 *
 * @param <M> the messages
 * @param <S> what is remembered between them
 */
public class Pending<M extends Timed, S> {
    List<M> waiting = new ArrayList<>(1);
    S remembered;

    Pending() {}

    final void takeOver(Pending<M, S> other) {
        waiting = other.waiting;
        remembered = other.remembered;
    }

    /** Removes what the watermark has passed, in no order. */
    final List<M> takeDue(long watermark) {
        int count = 0;
        for (M message : waiting) {
            count += message.time() <= watermark ? 1 : 0;
        }
        if (count == 0) {
            return List.of();
        }
        List<M> all = waiting;
        waiting = new ArrayList<>(Math.max(1, all.size() - count));
        if (count == all.size()) {
            return all;
        }
        List<M> due = new ArrayList<>(count);
        for (M message : all) {
            (message.time() <= watermark ? due : waiting).add(message);
        }
        return due;
    }

    final boolean isEmpty() {
        return remembered == null && waiting.isEmpty();
    }
}
