package io.furrow.control.alarm;

import java.util.List;
import java.util.Locale;
import java.util.Objects;

import com.fasterxml.jackson.annotation.JsonCreator;
import com.fasterxml.jackson.annotation.JsonValue;

import io.furrow.control.manager.StateJson;
import io.furrow.model.control.AlarmKind;

/**
 * A condition that needs attention: stored, and published as a record of {@code service.alarms} keyed by its id.
 *
 * @param alarm its id, {@code <kind>-<number>}; never reused
 * @param change its latest change
 * @param text human-readable sentence
 * @param devices devices concerned, at most {@value Cause#MAX_DEVICES}
 * @param raised when, epoch ms
 * @param changed when it last changed, epoch ms; a repeated cause is not a change
 * @param count how often the cause was observed, as of the last change
 * @param until when it expires, epoch ms; null if it is ended explicitly
 * @param mutedUntil end of its mute, epoch ms; null if it is not muted
 * @param acknowledgedBy user who acknowledged it; null if not named
 * @param reason why it was closed; null if it is not closed
 * @param sequence increases with each change of any alarm
 * @param group entity of the mission, domain or field that it belongs to; null if none
 * @param affected number of devices or pairs that a group alarm stands for now; null for an individual alarm
 * @param total out of how many; null if unknown
 * @param seen when its cause was last observed, epoch ms, as of the last change; null in a group alarm
 * @param inhibitedBy id of the alarm that inhibits its delivery; null if none
 * @param identity tenant, service path, types and subject; null where the subject is no entity and no pair
 */
public record Alarm(
        String alarm,
        AlarmKind kind,
        String subject,
        Severity severity,
        AlarmState state,
        Change change,
        String text,
        List<Cause.AffectedDevice> devices,
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
        String inhibitedBy,
        String identity) {
    /** Kinds of changes. */
    public enum Change {
        OPENED,
        /** Its extent, its text or its inhibiting alarm changed. */
        UPDATED,
        ACKNOWLEDGED,
        CLOSED,
        MUTED,
        UNMUTED;

        /** The value in records. */
        @JsonValue
        public String code() {
            return name().toLowerCase(Locale.ROOT);
        }

        @JsonCreator
        static Change of(String code) {
            return valueOf(code.toUpperCase(Locale.ROOT));
        }
    }

    /** @param mutedUntil null if it is not muted */
    public static Alarm raised(Cause cause, Long mutedUntil, long sequence, long now) {
        AlarmBuilder draft = new AlarmBuilder();
        draft.alarm = cause.kind().code() + "-" + sequence;
        draft.kind = cause.kind();
        draft.subject = cause.subject();
        draft.identity = cause.identity().equals(cause.subject()) ? null : cause.identity();
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
        return Cause.key(kind, identity == null ? subject : identity);
    }

    public boolean isMuted(long now) {
        return mutedUntil != null && now < mutedUntil;
    }

    /** Whether it is a group alarm, whose cause is always known. */
    boolean isOfGroup() {
        return affected != null;
    }

    /** Whether its devices and extent equal those of a cause. */
    boolean concerns(Cause cause) {
        Cause.Extent extent = cause.extent();
        return extent == null
                || devices.equals(cause.devices())
                        && Objects.equals(affected, extent.affected())
                        && Objects.equals(total, extent.total());
    }

    public Alarm numbered(long newSequence) {
        AlarmBuilder draft = new AlarmBuilder(this);
        draft.sequence = newSequence;
        return draft.build();
    }

    /** Returns the alarm in another state; the reason is null unless it is closed. */
    public Alarm become(AlarmState newState, String by, String why, long now) {
        AlarmBuilder draft = new AlarmBuilder(this);
        draft.state = newState;
        draft.change = newState == AlarmState.CLOSED ? Change.CLOSED : Change.ACKNOWLEDGED;
        draft.changed = now;
        draft.until = newState == AlarmState.CLOSED ? null : until;
        draft.acknowledgedBy = by;
        draft.reason = why;
        return draft.build();
    }

    /** @param newMutedUntil null to unmute */
    public Alarm muted(Long newMutedUntil, long now) {
        AlarmBuilder draft = new AlarmBuilder(this);
        draft.change = newMutedUntil == null ? Change.UNMUTED : Change.MUTED;
        draft.changed = now;
        draft.mutedUntil = newMutedUntil;
        return draft.build();
    }

    /** Counts another observation of the cause; text and extent stay unchanged. */
    Alarm repeated(Long newUntil, long now) {
        AlarmBuilder draft = new AlarmBuilder(this);
        draft.count = count == Integer.MAX_VALUE ? count : count + 1;
        draft.until = newUntil;
        draft.seen = now;
        return draft.build();
    }

    /** The cause goes on; it is not counted again. */
    Alarm lasting(Long newUntil, long now) {
        AlarmBuilder draft = new AlarmBuilder(this);
        draft.until = newUntil;
        draft.seen = now;
        return draft.build();
    }

    /** Whoever was notified of it need not know that it will end. */
    Alarm ending(long newUntil) {
        AlarmBuilder draft = new AlarmBuilder(this);
        draft.until = newUntil;
        return draft.build();
    }

    /** Copies text, devices and extent from the cause. */
    Alarm updated(Cause cause, long now) {
        AlarmBuilder draft = new AlarmBuilder(this);
        draft.describe(cause);
        draft.change = Change.UPDATED;
        draft.changed = now;
        return draft.build();
    }

    /** Copies the text alone from the cause: that is no change, so nobody is notified of it. */
    Alarm reworded(Cause cause) {
        AlarmBuilder draft = new AlarmBuilder(this);
        draft.text = cause.text();
        return draft.build();
    }

    /** @param by id of the inhibiting alarm; null if no longer inhibited */
    public Alarm inhibited(String by, long now) {
        AlarmBuilder draft = new AlarmBuilder(this);
        draft.inhibitedBy = by;
        draft.change = Change.UPDATED;
        draft.changed = now;
        return draft.build();
    }

    /** Returns the alarm as inhibited when it was raised, without a further change. */
    public Alarm inhibitedFromStart(String by) {
        AlarmBuilder draft = new AlarmBuilder(this);
        draft.inhibitedBy = by;
        return draft.build();
    }

    /** UTF-8 JSON; members without a value are omitted. */
    public byte[] toBytes() {
        return StateJson.write(this);
    }
}
