package io.furrow.control.alarm;

import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.annotation.JsonUnwrapped;

import io.furrow.model.control.AlarmKind;
import io.furrow.model.ngsi.StateRecord;
import io.furrow.model.text.Coded;

/**
 * A condition that needs attention: stored, and published as a record of {@code service.alarms} keyed by its id.
 *
 * @param change its latest change
 * @param sequence increases with each change of any alarm
 * @param group entity of the mission, domain or field that it belongs to; null if none
 * @param seen when its cause was last observed, epoch ms, as of the last change; null in a group alarm
 * @param inhibitedBy id of the alarm that inhibits its delivery; null if none
 * @param identity tenant, service path, types and subject; null where the subject is neither an entity nor a pair
 */
public record Alarm(
        @JsonUnwrapped Head head,
        AlarmState state,
        Change change,
        @JsonUnwrapped Description description,
        @JsonUnwrapped Period period,
        @JsonUnwrapped Handling handling,
        long sequence,
        String group,
        @JsonUnwrapped Extent extent,
        Long seen,
        String inhibitedBy,
        String identity)
        implements StateRecord {
    /**
     * The constant part of an alarm.
     *
     * @param alarm its id, {@code <kind>-<number>}; never reused
     */
    public record Head(String alarm, AlarmKind kind, String subject, Severity severity) {}

    /**
     * The text of an alarm and the devices that it concerns.
     *
     * @param text human-readable sentence
     * @param values numbers in the sentence, by name
     * @param details what the sentence says of single devices, or of a fault
     * @param devices devices concerned, at most {@value Cause#MAX_DEVICES}
     */
    public record Description(
            String text,
            @JsonInclude(JsonInclude.Include.NON_EMPTY) Map<String, Double> values,
            @JsonInclude(JsonInclude.Include.NON_EMPTY) List<Cause.Detail> details,
            List<Cause.AffectedDevice> devices) {
        private static Description of(Cause cause) {
            return new Description(cause.text(), cause.values(), cause.details(), cause.devices());
        }
    }

    /**
     * The period of an alarm.
     *
     * @param raised when, epoch ms
     * @param changed when it last changed, epoch ms; a repeated cause is not a change
     * @param count how often the cause was observed, as of the last change
     * @param until when it expires, epoch ms; null if it is ended explicitly
     */
    public record Period(long raised, long changed, int count, Long until) {
        private Period changedAt(long now) {
            return new Period(raised, now, count, until);
        }

        private Period until(Long newUntil) {
            return new Period(raised, changed, count, newUntil);
        }
    }

    /**
     * What users did about an alarm.
     *
     * @param mutedUntil end of its mute, epoch ms; null if it is not muted
     * @param acknowledgedBy user who acknowledged it; null if not named
     * @param reason why it was closed; null if it is not closed
     */
    public record Handling(Long mutedUntil, String acknowledgedBy, String reason) {}

    /**
     * The extent of a group alarm.
     *
     * @param affected number of devices or pairs that a group alarm stands for now; null for an individual alarm
     * @param total out of how many; null if unknown
     */
    public record Extent(Integer affected, Integer total) {
        private static Extent of(Cause cause) {
            Cause.Extent extent = cause.extent();
            return extent == null ? new Extent(null, null) : new Extent(extent.affected(), extent.total());
        }
    }

    public enum Change implements Coded {
        OPENED,
        /** Its extent, its text or its inhibiting alarm changed. */
        UPDATED,
        ACKNOWLEDGED,
        CLOSED,
        MUTED,
        UNMUTED;
    }

    /** @param mutedUntil null if it is not muted */
    public static Alarm raised(Cause cause, Long mutedUntil, long sequence, long now) {
        String id = cause.kind().code() + "-" + sequence;
        return new Alarm(
                new Head(id, cause.kind(), cause.subject(), Severity.of(cause.kind())),
                AlarmState.OPEN,
                Change.OPENED,
                Description.of(cause),
                new Period(now, now, 1, cause.until(now)),
                new Handling(mutedUntil, null, null),
                sequence,
                cause.group(),
                Extent.of(cause),
                cause.extent() == null ? Long.valueOf(now) : null,
                null,
                cause.identity().equals(cause.subject()) ? null : cause.identity());
    }

    public String alarm() {
        return head.alarm;
    }

    public AlarmKind kind() {
        return head.kind;
    }

    public String subject() {
        return head.subject;
    }

    String key() {
        return Cause.key(kind(), identity == null ? subject() : identity);
    }

    public boolean isMuted(long now) {
        return handling.mutedUntil != null && now < handling.mutedUntil;
    }

    /** Whether it is a group alarm, whose cause is always known. */
    boolean isOfGroup() {
        return extent.affected != null;
    }

    /** Whether its devices and extent equal those of a cause. */
    boolean concerns(Cause cause) {
        return cause.extent() == null || description.devices.equals(cause.devices()) && extent.equals(Extent.of(cause));
    }

    public Alarm numbered(long number) {
        return new Alarm(
                head, state, change, description, period, handling, number, group, extent, seen, inhibitedBy, identity);
    }

    /** Returns the alarm in another state; the reason is null unless it is closed. */
    public Alarm become(AlarmState newState, String by, String why, long now) {
        boolean closes = newState == AlarmState.CLOSED;
        return changed(
                newState,
                closes ? Change.CLOSED : Change.ACKNOWLEDGED,
                closes ? period.until(null) : period,
                new Handling(handling.mutedUntil, by, why),
                now);
    }

    /** @param newMutedUntil null to unmute */
    public Alarm muted(Long newMutedUntil, long now) {
        Change newChange = newMutedUntil == null ? Change.UNMUTED : Change.MUTED;
        Handling muted = new Handling(newMutedUntil, handling.acknowledgedBy, handling.reason);
        return changed(state, newChange, period, muted, now);
    }

    private Alarm updated(long now) {
        return changed(state, Change.UPDATED, period, handling, now);
    }

    private Alarm changed(AlarmState next, Change newChange, Period newPeriod, Handling newHandling, long now) {
        Period changedPeriod = newPeriod.changedAt(now);
        return new Alarm(
                head,
                next,
                newChange,
                description,
                changedPeriod,
                newHandling,
                sequence,
                group,
                extent,
                seen,
                inhibitedBy,
                identity);
    }

    /** Counts another observation of the cause; text and extent stay unchanged. */
    Alarm repeated(Long newUntil, long now) {
        int count = period.count == Integer.MAX_VALUE ? period.count : period.count + 1;
        return extended(new Period(period.raised, period.changed, count, newUntil), now);
    }

    /** Extends the period of a cause that continues, without counting it again. */
    Alarm extended(Long newUntil, long now) {
        return extended(period.until(newUntil), now);
    }

    /** Sets the time of its end; this is not a change that is published. */
    Alarm ending(long newUntil) {
        return extended(period.until(newUntil), seen);
    }

    /**
     * Returns the alarm as if it were seen and muted now, if a clock that was ahead says later; the same instance
     * otherwise.
     */
    Alarm notAfter(long now) {
        Alarm muted = this;
        if (handling.mutedUntil != null && period.changed > now) {
            muted = muted(handling.mutedUntil - period.changed + now, now);
        }
        if (seen == null || seen <= now) {
            return muted;
        }
        return muted.extended(period.until == null ? null : Long.valueOf(period.until - seen + now), now);
    }

    private Alarm extended(Period newPeriod, Long at) {
        return new Alarm(
                head,
                state,
                change,
                description,
                newPeriod,
                handling,
                sequence,
                group,
                extent,
                at,
                inhibitedBy,
                identity);
    }

    /** Copies text, devices and extent from the cause. */
    Alarm updated(Cause cause, long now) {
        return described(Description.of(cause), Extent.of(cause)).updated(now);
    }

    /** Copies only the text from the cause; this is not a change, so it is not delivered. */
    Alarm reworded(Cause cause) {
        return described(new Description(cause.text(), cause.values(), cause.details(), description.devices), extent);
    }

    private Alarm described(Description newDescription, Extent newExtent) {
        return new Alarm(
                head,
                state,
                change,
                newDescription,
                period,
                handling,
                sequence,
                group,
                newExtent,
                seen,
                inhibitedBy,
                identity);
    }

    /** @param by id of the inhibiting alarm; null if no longer inhibited */
    public Alarm inhibited(String by, long now) {
        return inhibitedFromStart(by).updated(now);
    }

    /** Returns the alarm as inhibited when it was raised, without a further change. */
    public Alarm inhibitedFromStart(String by) {
        return new Alarm(
                head, state, change, description, period, handling, sequence, group, extent, seen, by, identity);
    }
}
