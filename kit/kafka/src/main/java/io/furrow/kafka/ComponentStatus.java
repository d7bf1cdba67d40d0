package io.furrow.kafka;

import java.time.Instant;

import io.furrow.model.text.Coded;

/**
 * How it is with a part of the control plane, or with something that it needs.
 *
 * @param name as in {@code managers}
 * @param lastSuccess when it last did its work; null if it never did
 * @param detail a state or the reason of a failure, for people; may be empty
 */
public record ComponentStatus(String name, State state, Instant lastSuccess, String detail) {
    /** Whether it works. */
    public enum State implements Coded {
        UP,
        /** It does not work now, and will by itself once what it needs is back. */
        DOWN,
        /** It has ended, and only a restart of the process brings it back. */
        DEAD;
    }

    /** The same under another name. */
    public ComponentStatus named(String newName) {
        return new ComponentStatus(newName, state, lastSuccess, detail);
    }
}
