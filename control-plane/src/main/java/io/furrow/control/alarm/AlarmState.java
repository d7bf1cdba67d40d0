package io.furrow.control.alarm;

import java.util.Locale;

import com.fasterxml.jackson.annotation.JsonCreator;
import com.fasterxml.jackson.annotation.JsonValue;

/** Where an alarm is in its life. */
public enum AlarmState {
    OPEN,
    /** Somebody looks at it. */
    ACKNOWLEDGED,
    /** It is over; should the same happen again, that is another alarm. */
    CLOSED;

    /** Whether the one may follow the other. */
    boolean canBecome(AlarmState next) {
        return next.ordinal() > ordinal();
    }

    /** As records have it. */
    @JsonValue
    public String word() {
        return name().toLowerCase(Locale.ROOT);
    }

    @JsonCreator
    static AlarmState of(String word) {
        return valueOf(word.toUpperCase(Locale.ROOT));
    }
}
