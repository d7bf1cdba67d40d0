package io.furrow.analytics.presence;

/**
 * The entry of a device into a field, or its exit, certain after the dwell.
 *
 * @param phase entry or exit
 * @param stay with its {@code since}, and {@code left} if it is over
 * @param emitted when it was certain: the dwell after the device went in or out, epoch ms
 */
public record PresenceTransition(Phase phase, Visit stay, long emitted) {
    /** Entry or exit. */
    public enum Phase {
        ENTERED("entered"),
        LEFT("left");

        private final String code;

        Phase(String code) {
            this.code = code;
        }

        /** The code in messages. */
        public String code() {
            return code;
        }
    }

    /** When the device went in or out. */
    long time() {
        return phase == Phase.ENTERED ? stay.since() : stay.left();
    }
}
