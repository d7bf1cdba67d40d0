package io.furrow.control.alarm;

import io.furrow.model.text.Coded;

/** State in the life cycle of an alarm. */
public enum AlarmState implements Coded {
    OPEN,
    /** A user is handling it. */
    ACKNOWLEDGED,
    /** It has ended; the same cause raises a new alarm. */
    CLOSED;

    boolean canBecome(AlarmState next) {
        return next.ordinal() > ordinal();
    }
}
