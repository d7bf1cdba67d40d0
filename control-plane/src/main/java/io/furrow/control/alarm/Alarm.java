package io.furrow.control.alarm;

import java.util.List;
import java.util.Locale;

import com.fasterxml.jackson.annotation.JsonCreator;
import com.fasterxml.jackson.annotation.JsonValue;

import io.furrow.control.manager.StateJson;
import io.furrow.model.control.AlarmKind;

/**
 * Something that somebody ought to look at: remembered, and a record of {@code service.alarms} under its id.
 *
 * @param alarm its id, {@code <kind>-<number>}; never given twice
 * @param change what happened to it last
 * @param text a sentence for people
 * @param raised when, epoch ms
 * @param changed when it last changed, epoch ms; that its cause is seen again is no change
 * @param count how often the cause was seen, as of the last change
 * @param until when it is over by itself, epoch ms; null where something else says so
 * @param mutedUntil until when nobody is told of it, epoch ms; null where it is not muted
 * @param acknowledgedBy who looks at it; null where nobody said so
 * @param reason why it is closed; null where it is not
 * @param sequence grows with each change of any alarm
 */
public record Alarm(
        String alarm,
        AlarmKind kind,
        String subject,
        Severity severity,
        AlarmState state,
        Change change,
        String text,
        List<Cause.Device> devices,
        long raised,
        long changed,
        int count,
        Long until,
        Long mutedUntil,
        String acknowledgedBy,
        String reason,
        long sequence) {
    /** What may happen to an alarm. */
    public enum Change {
        OPENED,
        ACKNOWLEDGED,
        CLOSED,
        MUTED,
        UNMUTED;

        /** As records have it. */
        @JsonValue
        public String word() {
            return name().toLowerCase(Locale.ROOT);
        }

        @JsonCreator
        static Change of(String word) {
            return valueOf(word.toUpperCase(Locale.ROOT));
        }
    }

    /** @param mutedUntil null where nothing mutes it */
    static Alarm raised(Cause cause, Long mutedUntil, long sequence, long now) {
        return new Alarm(
                cause.kind().code() + "-" + sequence,
                cause.kind(),
                cause.subject(),
                Severity.of(cause.kind()),
                AlarmState.OPEN,
                Change.OPENED,
                cause.text(),
                List.copyOf(cause.devices()),
                now,
                now,
                1,
                cause.until(now),
                mutedUntil,
                null,
                null,
                sequence);
    }

    String key() {
        return Cause.key(kind, subject);
    }

    boolean isMuted(long now) {
        return mutedUntil != null && now < mutedUntil;
    }

    Alarm numbered(long newSequence) {
        return new Alarm(
                alarm,
                kind,
                subject,
                severity,
                state,
                change,
                text,
                devices,
                raised,
                changed,
                count,
                until,
                mutedUntil,
                acknowledgedBy,
                reason,
                newSequence);
    }

    /** The same in another state; the reason is null but where it is closed. */
    Alarm become(AlarmState newState, String by, String why, long now) {
        return new Alarm(
                alarm,
                kind,
                subject,
                severity,
                newState,
                newState == AlarmState.CLOSED ? Change.CLOSED : Change.ACKNOWLEDGED,
                text,
                devices,
                raised,
                now,
                count,
                newState == AlarmState.CLOSED ? null : until,
                mutedUntil,
                by,
                why,
                sequence);
    }

    /** @param newMutedUntil null for not any more */
    Alarm muted(Long newMutedUntil, long now) {
        return new Alarm(
                alarm,
                kind,
                subject,
                severity,
                state,
                newMutedUntil == null ? Change.UNMUTED : Change.MUTED,
                text,
                devices,
                raised,
                now,
                count,
                until,
                newMutedUntil,
                acknowledgedBy,
                reason,
                sequence);
    }

    Alarm repeated(Long newUntil) {
        return new Alarm(
                alarm,
                kind,
                subject,
                severity,
                state,
                change,
                text,
                devices,
                raised,
                changed,
                count == Integer.MAX_VALUE ? count : count + 1,
                newUntil,
                mutedUntil,
                acknowledgedBy,
                reason,
                sequence);
    }

    byte[] toBytes() {
        return StateJson.write(this);
    }
}
