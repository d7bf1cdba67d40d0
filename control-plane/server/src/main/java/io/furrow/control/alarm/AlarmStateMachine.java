package io.furrow.control.alarm;

import java.time.Duration;
import java.util.Objects;

import io.furrow.model.control.AlarmKind;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RejectedException;

/** Computes the life cycle of an alarm: open, acknowledged, closed. A pure function of an alarm and an event. */
final class AlarmStateMachine {
    /** A cause observed within this time is considered active, so that its alarm cannot be closed manually. */
    static final Duration CAUSE_LASTS = Duration.ofMinutes(1);
    /** Minimum time between two updates of the extent of a group alarm. */
    static final Duration UPDATE_INTERVAL = Duration.ofSeconds(10);

    private AlarmStateMachine() {}

    /**
     * Returns the next state of the alarm, or the same instance if nothing changes.
     *
     * @throws RejectedException if the event is not allowed in the alarm's state
     */
    static Alarm next(Alarm alarm, AlarmEvent event, long now) throws RejectedException {
        if (event instanceof AlarmEvent.TimePassed) {
            return afterTime(alarm, now);
        }
        if (alarm.state() == AlarmState.CLOSED) {
            throw wrongState(alarm);
        }
        if (event instanceof AlarmEvent.Repeated repeated) {
            return alarm.repeated(repeated.until(), now);
        } else if (event instanceof AlarmEvent.Reported reported) {
            return reported(alarm, reported, now);
        } else if (event instanceof AlarmEvent.Ended ended) {
            return alarm.become(AlarmState.CLOSED, alarm.handling().acknowledgedBy(), ended.reason(), now);
        } else if (event instanceof AlarmEvent.ManuallyClosed by) {
            return closedManually(alarm, by, now);
        } else if (event instanceof AlarmEvent.Acknowledged by) {
            if (!alarm.state().canBecome(AlarmState.ACKNOWLEDGED)) {
                throw wrongState(alarm);
            }
            return alarm.become(AlarmState.ACKNOWLEDGED, by.user(), null, now);
        } else if (event instanceof AlarmEvent.Muted muted) {
            return alarm.muted(muted.until(), now);
        }
        return alarm.handling().mutedUntil() == null ? alarm : alarm.muted(null, now);
    }

    private static Alarm reported(Alarm alarm, AlarmEvent.Reported reported, long now) {
        boolean inhibition = !Objects.equals(alarm.inhibitedBy(), reported.inhibitedBy());
        boolean extent =
                !alarm.concerns(reported.cause()) && now - alarm.period().changed() >= UPDATE_INTERVAL.toMillis();
        if (!inhibition && !extent) {
            return alarm;
        }
        Alarm updated = alarm.updated(reported.cause(), now);
        return inhibition ? updated.inhibited(reported.inhibitedBy(), now) : updated;
    }

    private static Alarm closedManually(Alarm alarm, AlarmEvent.ManuallyClosed event, long now)
            throws RejectedException {
        Duration ago = alarm.seen() == null ? null : Duration.ofMillis(now - alarm.seen());
        boolean lasts = alarm.isOfGroup() ? !event.isOver() : ago != null && ago.compareTo(CAUSE_LASTS) < 0;
        if (lasts) {
            String seen = alarm.isOfGroup() ? "" : " (seen %d s ago)".formatted(ago.toSeconds());
            throw new RejectedException(
                    ErrorCode.WRONG_STATE,
                    "alarm '%s' closes when its cause is over: %s%s. Acknowledge it, or mute it for a while."
                            .formatted(alarm.alarm(), alarm.description().text(), seen));
        }
        String by = event.user() == null ? "somebody" : event.user();
        return alarm.become(AlarmState.CLOSED, alarm.handling().acknowledgedBy(), "closed by " + by, now);
    }

    private static Alarm afterTime(Alarm alarm, long now) {
        if (alarm.state() == AlarmState.CLOSED) {
            return alarm;
        }
        if (alarm.period().until() != null && alarm.period().until() <= now) {
            return alarm.become(AlarmState.CLOSED, alarm.handling().acknowledgedBy(), expired(alarm), now);
        }
        return alarm.handling().mutedUntil() != null && alarm.handling().mutedUntil() <= now
                ? alarm.muted(null, now)
                : alarm;
    }

    /** The report of its end lets a collision expire at another time than its other reports. */
    private static String expired(Alarm alarm) {
        if (alarm.kind() != AlarmKind.COLLISION || alarm.seen() == null) {
            return "its cause was no longer observed";
        }
        Duration holds = AlarmCommandHandler.COLLISION_HOLDS;
        return alarm.period().until() - alarm.seen() == holds.toMillis()
                ? "nothing was reported of the encounter for %d min, not its end either".formatted(holds.toMinutes())
                : "the encounter has ended, and the pair has had no other since";
    }

    private static RejectedException wrongState(Alarm alarm) {
        return new RejectedException(
                ErrorCode.WRONG_STATE,
                "alarm '%s' is %s already"
                        .formatted(alarm.alarm(), alarm.state().code()));
    }
}
