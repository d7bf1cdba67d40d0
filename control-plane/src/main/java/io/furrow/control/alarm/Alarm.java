package io.furrow.control.alarm;

import java.util.List;
import java.util.Locale;
import java.util.Objects;

import com.fasterxml.jackson.annotation.JsonCreator;
import com.fasterxml.jackson.annotation.JsonValue;

import io.furrow.control.manager.StateJson;
import io.furrow.model.control.AlarmKind;

/**
 * Something that needs attention: stored, and a record of {@code service.alarms} under its id. Members that an earlier version
 * did not write are null.
 *
 * @param alarm its id, {@code <kind>-<number>}; never given twice
 * @param change what happened to it last
 * @param text a sentence for people
 * @param devices that it concerns; of a group of many the first {@value Cause#MAX_DEVICES}
 * @param raised when, epoch ms
 * @param changed when it last changed, epoch ms; that its cause is seen again is no change
 * @param count how often the cause was seen, as of the last change
 * @param until when it is over by itself, epoch ms; null where something else says so
 * @param mutedUntil until when it is not delivered, epoch ms; null where it is not muted
 * @param acknowledgedBy who acknowledged it; null where no user was named
 * @param reason why it is closed; null where it is not
 * @param sequence grows with each change of any alarm
 * @param group entity of the mission, domain or field that it belongs to; null where it belongs to none
 * @param affected how many devices or pairs a group alarm stands for now; null where the alarm is of one only
 * @param total out of how many; null where that is not known
 * @param seen when its cause was last seen, epoch ms, as of the last change; null in a group alarm
 * @param inhibitedBy id of the alarm that says more, because of which this one is not delivered; null where there is none
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
        long sequence,
        String group,
        Integer affected,
        Integer total,
        Long seen,
        String inhibitedBy) {
    /** What may happen to an alarm. */
    public enum Change {
        OPENED,
        /** Its extent, its text or what inhibits it. */
        UPDATED,
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
        AlarmDraft draft = new AlarmDraft();
        draft.alarm = cause.kind().code() + "-" + sequence;
        draft.kind = cause.kind();
        draft.subject = cause.subject();
        draft.severity = Severity.of(cause.kind());
        draft.state = AlarmState.OPEN;
        draft.change = Change.OPENED;
        draft.describe(cause);
        draft.raised = now;
        draft.changed = now;
        draft.count = 1;
        draft.until = cause.until(now);
        draft.mutedUntil = mutedUntil;
        draft.sequence = sequence;
        draft.group = cause.group();
        draft.seen = cause.extent() == null ? Long.valueOf(now) : null;
        return draft.build();
    }

    String key() {
        return Cause.key(kind, subject);
    }

    boolean isMuted(long now) {
        return mutedUntil != null && now < mutedUntil;
    }

    /** Whether it stands for many: then its cause is known at every moment. */
    boolean isOfGroup() {
        return affected != null;
    }

    /** Whether it says what a cause says. */
    boolean says(Cause cause) {
        Cause.Extent extent = cause.extent();
        return extent == null
                || text.equals(cause.text())
                        && devices.equals(cause.devices())
                        && Objects.equals(affected, extent.affected())
                        && Objects.equals(total, extent.total());
    }

    Alarm numbered(long newSequence) {
        AlarmDraft draft = new AlarmDraft(this);
        draft.sequence = newSequence;
        return draft.build();
    }

    /** The same in another state; the reason is null but where it is closed. */
    Alarm become(AlarmState newState, String by, String why, long now) {
        AlarmDraft draft = new AlarmDraft(this);
        draft.state = newState;
        draft.change = newState == AlarmState.CLOSED ? Change.CLOSED : Change.ACKNOWLEDGED;
        draft.changed = now;
        draft.until = newState == AlarmState.CLOSED ? null : until;
        draft.acknowledgedBy = by;
        draft.reason = why;
        return draft.build();
    }

    /** @param newMutedUntil null for not any more */
    Alarm muted(Long newMutedUntil, long now) {
        AlarmDraft draft = new AlarmDraft(this);
        draft.change = newMutedUntil == null ? Change.UNMUTED : Change.MUTED;
        draft.changed = now;
        draft.mutedUntil = newMutedUntil;
        return draft.build();
    }

    /** The cause was seen once more; what the alarm says stays. */
    Alarm repeated(Long newUntil, long now) {
        AlarmDraft draft = new AlarmDraft(this);
        draft.count = count == Integer.MAX_VALUE ? count : count + 1;
        draft.until = newUntil;
        draft.seen = now;
        return draft.build();
    }

    /** Says what the cause says. */
    Alarm updated(Cause cause, long now) {
        AlarmDraft draft = new AlarmDraft(this);
        draft.describe(cause);
        draft.change = Change.UPDATED;
        draft.changed = now;
        return draft.build();
    }

    /** @param by id of an alarm; null for none any more */
    Alarm inhibited(String by, long now) {
        AlarmDraft draft = new AlarmDraft(this);
        draft.inhibitedBy = by;
        draft.change = Change.UPDATED;
        draft.changed = now;
        return draft.build();
    }

    /** The same alarm that was inhibited when it was raised. */
    Alarm inhibitedFromStart(String by) {
        AlarmDraft draft = new AlarmDraft(this);
        draft.inhibitedBy = by;
        return draft.build();
    }

    /** UTF-8 JSON; members without a value are left out. */
    byte[] toBytes() {
        return StateJson.write(this);
    }
}
