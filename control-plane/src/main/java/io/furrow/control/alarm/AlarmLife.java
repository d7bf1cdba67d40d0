package io.furrow.control.alarm;

import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RefusedException;

/** The life of an alarm: open, acknowledged, closed. Pure: an alarm, what happens, the alarm after that. */
final class AlarmLife {
    private AlarmLife() {}

    /**
     * Answers the same alarm where nothing changes.
     *
     * @throws RefusedException where that cannot happen to an alarm in its state
     */
    static Alarm next(Alarm alarm, AlarmEvent event, long now) throws RefusedException {
        if (event instanceof AlarmEvent.TimePassed) {
            return afterTime(alarm, now);
        }
        if (alarm.state() == AlarmState.CLOSED) {
            throw wrongState(alarm);
        }
        if (event instanceof AlarmEvent.Repeated repeated) {
            return alarm.repeated(repeated.until());
        } else if (event instanceof AlarmEvent.Ended ended) {
            return alarm.become(AlarmState.CLOSED, alarm.acknowledgedBy(), ended.reason(), now);
        } else if (event instanceof AlarmEvent.Acknowledged by) {
            if (!alarm.state().canBecome(AlarmState.ACKNOWLEDGED)) {
                throw wrongState(alarm);
            }
            return alarm.become(AlarmState.ACKNOWLEDGED, by.user(), null, now);
        } else if (event instanceof AlarmEvent.Muted muted) {
            return alarm.muted(muted.until(), now);
        }
        return alarm.mutedUntil() == null ? alarm : alarm.muted(null, now);
    }

    private static Alarm afterTime(Alarm alarm, long now) {
        if (alarm.state() == AlarmState.CLOSED) {
            return alarm;
        }
        if (alarm.until() != null && alarm.until() <= now) {
            return alarm.become(AlarmState.CLOSED, alarm.acknowledgedBy(), "it was not seen any more", now);
        }
        return alarm.mutedUntil() != null && alarm.mutedUntil() <= now ? alarm.muted(null, now) : alarm;
    }

    private static RefusedException wrongState(Alarm alarm) {
        return new RefusedException(
                ErrorCode.WRONG_STATE,
                "alarm '%s' is %s already"
                        .formatted(alarm.alarm(), alarm.state().word()));
    }
}
