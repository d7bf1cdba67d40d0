package io.furrow.analytics.collision.encounter;

import java.util.Locale;

/** The part of an encounter's life that a record reports. */
public enum Phase {
    STARTED,
    /** The devices are still close; reported at a limited rate. */
    ONGOING,
    ENDED,
    /** The devices' courses will bring them close. */
    PREDICTED,
    /** The devices came close between their reports, but no report shows it. */
    CROSSED;

    /** The name in messages, for instance {@code started}. */
    public String code() {
        return name().toLowerCase(Locale.ROOT);
    }
}
