package io.furrow.control.alarm;

import java.util.Locale;

import com.fasterxml.jackson.annotation.JsonValue;

/** State in the life cycle of an alarm. */
public enum AlarmState {
    OPEN,
    /** Somebody is dealing with it. */
    ACKNOWLEDGED,
    /** It has ended; the same cause raises a new alarm. */
    CLOSED;

    /** Whether the transition is allowed. */
    boolean canBecome(AlarmState next) {
        return next.ordinal() > ordinal();
    }

    /** The value in records. */
    @JsonValue
    public String code() {
        return name().toLowerCase(Locale.ROOT);
    }
}
