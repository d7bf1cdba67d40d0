package io.furrow.kafka;

import java.time.Instant;

import io.furrow.model.text.Coded;

/**
 * The status of a part of the control plane, or of a server that it depends on.
 *
 * @param name as in {@code managers}
 * @param lastSuccess time of its last success; null if there is none
 * @param detail a state or the reason of a failure, for display; may be empty
 */
public record ComponentStatus(String name, State state, Instant lastSuccess, String detail) {
    /** Whether it works. */
    public enum State implements Coded {
        UP,
        /** It does not work now, and recovers by itself once its dependencies are back. */
        DOWN,
        /** It has ended, and only a restart of the process recovers it. */
        DEAD;
    }

    /** The same under another name. */
    public ComponentStatus named(String newName) {
        return new ComponentStatus(newName, state, lastSuccess, detail);
    }
}
