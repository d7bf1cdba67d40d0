package io.furrow.analytics.eventtime;

import java.util.ArrayList;
import java.util.List;

/**
 * All that a key has, in one value: messages that wait for the watermark, what is remembered, and when its timers ring.
 * Changed in place.
 *
 * @param <M> the messages
 * @param <S> what is remembered between them
 */
public final class Pending<M extends Timed, S> {
    static final long NO_TIMER = Long.MAX_VALUE;

    List<M> waiting = new ArrayList<>(1);
    S remembered;
    /** For the earliest message. */
    long wakeAt = NO_TIMER;
    /** At or before the instant at which what is remembered ends. */
    long expiryAt = NO_TIMER;

    Pending() {}

    /** Removes what the watermark has passed, in no order. */
    List<M> takeDue(long watermark) {
        List<M> due = new ArrayList<>(waiting.size());
        List<M> later = new ArrayList<>(1);
        for (M message : waiting) {
            (message.time() <= watermark ? due : later).add(message);
        }
        waiting = later;
        return due;
    }

    long earliest() {
        long earliest = NO_TIMER;
        for (M message : waiting) {
            earliest = Math.min(earliest, message.time());
        }
        return earliest;
    }

    void rang(long time) {
        wakeAt = wakeAt == time ? NO_TIMER : wakeAt;
        expiryAt = expiryAt == time ? NO_TIMER : expiryAt;
    }

    boolean isEmpty() {
        return remembered == null && waiting.isEmpty();
    }
}
