package io.furrow.analytics.presence;

/**
 * A device went into a field or out of it, and stayed so for the dwell.
 *
 * @param phase which of both
 * @param stay with its {@code since}, and {@code left} where it is over
 * @param emitted when it was certain: the dwell after the device went in or out, epoch ms
 */
public record PresenceTransition(Phase phase, Visit stay, long emitted) {
    /** In or out. */
    public enum Phase {
        ENTERED("entered"),
        LEFT("left");

        private final String code;

        Phase(String code) {
            this.code = code;
        }

        /** As messages have it. */
        public String code() {
            return code;
        }
    }

    /** When the device went in or out. */
    long time() {
        return phase == Phase.ENTERED ? stay.since() : stay.left();
    }
}
