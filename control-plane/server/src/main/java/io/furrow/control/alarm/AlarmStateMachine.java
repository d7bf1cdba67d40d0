package io.furrow.control.alarm;

import java.time.Duration;
import java.util.Objects;

import io.furrow.model.control.AlarmKind;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RejectedException;
import io.furrow.model.time.Elapsed;

/** Computes the life cycle of an alarm: open, acknowledged, closed. A pure function of an alarm and an event. */
final class AlarmStateMachine {
    /** A cause observed within this time is considered active, so that its alarm cannot be closed manually. */
    static final Duration ACTIVE_TIMEOUT = Duration.ofMinutes(1);
    /** Minimum time between two updates of the extent of a group alarm. */
    static final Duration UPDATE_INTERVAL = Duration.ofSeconds(10);

    private AlarmStateMachine() {}

    interface Event {
        /**
         * Returns the next state of the alarm, or the same instance if nothing changes.
         *
         * @throws RejectedException if it is not allowed in the alarm's state
         */
        Alarm next(Alarm alarm, long now) throws RejectedException;
    }

    /** The cause was observed again. @param until new end of validity, epoch ms; null if it lasts until ended explicitly */
    static Event repeated(Long until) {
        return ofOpen((alarm, now) -> alarm.repeated(until, now));
    }

    /** The current extent of a group alarm. @param inhibitedBy id of the inhibiting alarm; null if none */
    static Event reported(Cause cause, String inhibitedBy) {
        return ofOpen((alarm, now) -> {
            boolean inhibition = !Objects.equals(alarm.inhibitedBy(), inhibitedBy);
            boolean extent = !alarm.concerns(cause)
                    && Elapsed.hasPassed(
                            UPDATE_INTERVAL.toMillis(), alarm.period().changed(), now);
            if (!inhibition && !extent) {
                return alarm;
            }
            Alarm updated = alarm.updated(cause, now);
            return inhibition ? updated.inhibited(inhibitedBy, now) : updated;
        });
    }

    static Event ended(String reason) {
        return ofOpen((alarm, now) -> closed(alarm, reason, now));
    }

    /**
     * A user closes it.
     *
     * @param user null if not named
     * @param causesEnded for a group alarm, whether none of its causes was reported recently
     */
    static Event closedManually(String user, boolean causesEnded) {
        return ofOpen((alarm, now) -> {
            boolean active = alarm.isOfGroup()
                    ? !causesEnded
                    : alarm.seen() != null && !Elapsed.hasPassed(ACTIVE_TIMEOUT.toMillis(), alarm.seen(), now);
            if (active) {
                String seen = alarm.isOfGroup() ? "" : " (seen %d s ago)".formatted((now - alarm.seen()) / 1000);
                throw new RejectedException(
                        ErrorCode.WRONG_STATE,
                        "alarm '%s' closes when its cause is over: %s%s. Acknowledge it, or mute it for a while."
                                .formatted(alarm.alarm(), alarm.description().text(), seen));
            }
            return closed(alarm, "closed by " + (user == null ? "somebody" : user), now);
        });
    }

    /** @param user null if not named */
    static Event acknowledged(String user) {
        return ofOpen((alarm, now) -> {
            if (!alarm.state().canBecome(AlarmState.ACKNOWLEDGED)) {
                throw wrongState(alarm);
            }
            return alarm.become(AlarmState.ACKNOWLEDGED, user, null, now);
        });
    }

    /** @param until end of the mute, epoch ms; null to unmute */
    static Event muted(Long until) {
        return ofOpen((alarm, now) ->
                until == null && alarm.handling().mutedUntil() == null ? alarm : alarm.muted(until, now));
    }

    /** Applies expiry and the end of a mute. */
    static Alarm afterTime(Alarm alarm, long now) {
        if (alarm.state() == AlarmState.CLOSED) {
            return alarm;
        }
        if (alarm.period().until() != null && alarm.period().until() <= now) {
            return closed(alarm, expired(alarm), now);
        }
        return alarm.handling().mutedUntil() != null && alarm.handling().mutedUntil() <= now
                ? alarm.muted(null, now)
                : alarm;
    }

    private static Event ofOpen(Event event) {
        return (alarm, now) -> {
            if (alarm.state() == AlarmState.CLOSED) {
                throw wrongState(alarm);
            }
            return event.next(alarm, now);
        };
    }

    private static Alarm closed(Alarm alarm, String reason, long now) {
        return alarm.become(AlarmState.CLOSED, alarm.handling().acknowledgedBy(), reason, now);
    }

    /** Returns the reason of an expiry. A collision whose end was reported expires at another time than one whose reports stopped. */
    private static String expired(Alarm alarm) {
        if (alarm.kind() != AlarmKind.COLLISION || alarm.seen() == null) {
            return "its cause was no longer observed";
        }
        Duration validity = AlarmCommandHandler.COLLISION_VALIDITY;
        return alarm.period().until() - alarm.seen() == validity.toMillis()
                ? "no report of the encounter for %d min, not even of its end".formatted(validity.toMinutes())
                : "the encounter has ended, and the pair has had no other since";
    }

    private static RejectedException wrongState(Alarm alarm) {
        return new RejectedException(
                ErrorCode.WRONG_STATE,
                "alarm '%s' is %s already"
                        .formatted(alarm.alarm(), alarm.state().code()));
    }
}
