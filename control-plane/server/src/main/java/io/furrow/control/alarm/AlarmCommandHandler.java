package io.furrow.control.alarm;

import java.time.Duration;
import java.util.Comparator;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.OptionalLong;
import java.util.Set;
import java.util.function.Predicate;

import io.furrow.control.manager.CommandHandler;
import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.Sequence;
import io.furrow.model.control.AlarmCommand;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Limits;
import io.furrow.model.control.RejectedException;
import io.furrow.model.time.Elapsed;
import io.furrow.model.topic.Topics;

/**
 * Raises alarms, applies causes and commands to them, and publishes them on {@code service.alarms}. There is at most
 * one alarm per kind and identity of a subject that is not closed. A closed alarm is retained for a day, at most the
 * {@value #MAX_CLOSED} newest, then removed.
 */
public final class AlarmCommandHandler implements CommandHandler<AlarmCommand> {
    /**
     * How long a collision lasts without a record of its encounter: many times the interval between records of an
     * ongoing encounter, which the time-to-live of its devices limits.
     */
    public static final Duration COLLISION_VALIDITY = Duration.ofHours(1);

    static final Duration CLOSED_RETENTION = Duration.ofDays(1);
    static final int MAX_CLOSED = 10_000;

    private static final long CLEARING_INTERVAL = Duration.ofMinutes(1).toMillis();
    private static final String ALL = "";

    private final AlarmTables tables;
    private final Sequence sequence;
    private final EventPublisher publisher;
    private final AlarmLimit limit;
    private long cleared;

    AlarmCommandHandler(AlarmTables tables, Sequence sequence, EventPublisher publisher) {
        this.tables = tables;
        this.sequence = sequence;
        this.publisher = publisher;
        this.limit = new AlarmLimit(tables.groups(), tables.overflows());
    }

    /** Raises an alarm, or refreshes the existing one. If its group has reached the limit, the cause is only counted. */
    public void raise(Cause cause, long now) {
        Alarm existing = current(cause.kind(), cause.identity());
        if (existing != null) {
            tables.alarms().put(existing.alarm(), apply(existing, AlarmStateMachine.repeated(cause.until(now)), now));
        } else if (!limit.count(cause, now)) {
            store(Alarm.raised(cause, mutedUntil(cause, now), sequence.next(), now));
        }
    }

    /** As {@link #raise}, but an ongoing cause does not increase the count of an existing alarm. */
    public void raiseOrExtend(Cause cause, long now) {
        Alarm existing = current(cause.kind(), cause.identity());
        if (existing == null) {
            raise(cause, now);
        } else {
            tables.alarms().put(existing.alarm(), existing.extended(cause.until(now), now));
        }
    }

    /** As {@link #raise}, but an existing alarm gets the text of the cause. */
    public void raiseReworded(Cause cause, long now) {
        Alarm existing = current(cause.kind(), cause.identity());
        if (existing != null) {
            reworded(existing, cause);
        }
        raise(cause, now);
    }

    /** Rewords the alarm of a cause, if there is one and a value of the cause is less than that of the alarm. */
    public void lower(Cause cause, String name) {
        Alarm existing = current(cause.kind(), cause.identity());
        Double value = cause.values().get(name);
        if (existing != null && value != null) {
            Map<String, Double> before = existing.description().values(); // null in alarms of older versions
            if (before == null || value < before.getOrDefault(name, Double.POSITIVE_INFINITY)) {
                reworded(existing, cause);
            }
        }
    }

    /** Closes the alarm of a kind and identity, if there is one. */
    public void end(AlarmKind kind, String identity, String reason, long now) {
        Alarm existing = current(kind, identity);
        if (existing != null) {
            change(existing, AlarmStateMachine.ended(reason), now);
        } else {
            limit.end(kind, identity);
        }
    }

    /** As {@link #raise}, for a cause that has started again: the new count of an existing alarm is published. */
    public void raiseAgain(Cause cause, long now) {
        boolean exists = current(cause.kind(), cause.identity()) != null;
        raise(cause, now);
        if (exists) {
            store(current(cause.kind(), cause.identity()));
        }
    }

    /** Makes the alarm of a kind and identity, if there is one, expire at a time unless it is raised again before. */
    public void endAt(AlarmKind kind, String identity, long until) {
        Alarm existing = current(kind, identity);
        if (existing != null) {
            tables.alarms().put(existing.alarm(), existing.ending(until));
        } else {
            limit.endAt(kind, identity, until);
        }
    }

    /**
     * Raises or updates the alarm of a group cause. If only the text changed, the alarm keeps its sequence number, so
     * that the new text is delivered only with the next repetition.
     *
     * @param inhibitor cause, reported before, whose alarm inhibits the delivery of this one; null if none
     */
    public void report(Cause cause, Cause inhibitor, long now) {
        String by = inhibitor == null ? null : tables.current().get(inhibitor.key());
        Alarm existing = current(cause.kind(), cause.identity());
        if (existing == null) {
            Long muted = mutedUntil(cause, now);
            Alarm raised = Alarm.raised(cause, muted, sequence.next(), now);
            store(by == null ? raised : raised.inhibitedFromStart(by));
        } else {
            change(reworded(existing, cause), AlarmStateMachine.reported(cause, by), now);
        }
    }

    private Alarm reworded(Alarm existing, Cause cause) {
        if (!existing.concerns(cause) || existing.description().text().equals(cause.text())) {
            return existing;
        }
        Alarm reworded = existing.reworded(cause);
        store(reworded);
        return reworded;
    }

    /** Closes the alarms of the given kinds that have none of the given causes. */
    public void endOthers(Set<AlarmKind> kinds, List<Cause> causes, String reason, long now) {
        endOthers(alarm -> kinds.contains(alarm.kind()), causes, reason, now);
    }

    private void endOthers(Predicate<Alarm> some, List<Cause> causes, String reason, long now) {
        Set<String> activeKeys = new HashSet<>();
        causes.forEach(cause -> activeKeys.add(cause.key()));
        for (Alarm alarm : current()) {
            if (some.test(alarm) && !activeKeys.contains(alarm.key())) {
                change(alarm, AlarmStateMachine.ended(reason), now);
            }
        }
    }

    /** Whether there is an alarm of a kind and identity that is not closed. */
    public boolean isRaised(AlarmKind kind, String identity) {
        return current(kind, identity) != null;
    }

    /** Whether a kind is muted for one subject or identity. */
    public boolean isMuted(AlarmKind kind, String subject, long now) {
        AlarmTables.Mute mute = tables.mutes().get(Cause.key(kind, subject));
        return mute != null && mute.until() > now;
    }

    @Override
    public OptionalLong sequenceOf(AlarmCommand command) {
        Alarm existing = command.alarm() == null ? null : tables.alarms().get(command.alarm());
        return existing == null ? OptionalLong.empty() : OptionalLong.of(existing.sequence());
    }

    @Override
    public CommandResult answer(AlarmCommand command, long now) throws RejectedException {
        if (command instanceof AlarmCommand.Acknowledge acknowledge) {
            return answer(acknowledge.alarm(), AlarmStateMachine.acknowledged(acknowledge.user()), "acknowledged", now);
        } else if (command instanceof AlarmCommand.Close close) {
            return answer(close.alarm(), dismissal(close, now), "closed", now);
        } else if (command instanceof AlarmCommand.Mute mute) {
            long until = now + mute.time().toMillis();
            return muted(mute.target(), until, now).with("until", until);
        }
        return muted(((AlarmCommand.Unmute) command).target(), null, now);
    }

    private AlarmStateMachine.Event dismissal(AlarmCommand.Close close, long now) {
        Alarm alarm = tables.alarms().get(close.alarm());
        boolean causesEnded = alarm != null
                && alarm.isOfGroup()
                && alarm.state() != AlarmState.CLOSED
                && AlarmLimit.KINDS.contains(alarm.kind())
                && limit.clear(alarm.kind(), alarm.subject(), now);
        return AlarmStateMachine.closedManually(close.user(), causesEnded);
    }

    private CommandResult answer(String id, AlarmStateMachine.Event event, String status, long now)
            throws RejectedException {
        Alarm alarm = tables.alarms().get(id);
        if (alarm == null) {
            throw new RejectedException(
                    ErrorCode.UNKNOWN_ALARM, "there is no alarm '%s', or it was closed long ago".formatted(id));
        }
        Alarm next = event.next(alarm, now);
        if (next != alarm) {
            store(next.numbered(sequence.next()));
        }
        return CommandResult.of(status).with(AlarmCommand.ALARM, id);
    }

    /** @param until null to unmute */
    private CommandResult muted(AlarmCommand.Target target, Long until, long now) throws RejectedException {
        AlarmStateMachine.Event event = AlarmStateMachine.muted(until);
        String status = until == null ? "unmuted" : "muted";
        if (target instanceof AlarmCommand.OfAlarm of) {
            return answer(of.alarm(), event, status, now);
        }
        AlarmCommand.OfKind of = (AlarmCommand.OfKind) target;
        String key = Cause.key(of.kind(), of.subject() == null ? ALL : of.subject());
        requireRoomFor(key, until);
        tables.mutes().put(key, until == null ? null : new AlarmTables.Mute(key, until, now));
        for (Alarm alarm : current()) {
            if (alarm.kind() == of.kind()
                    && (of.subject() == null
                            || of.subject().equals(alarm.subject())
                            || of.subject().equals(alarm.identity()))) {
                change(alarm, event, now);
            }
        }
        return CommandResult.of(status).with("kind", of.kind().code()).with("subject", of.subject());
    }

    private void requireRoomFor(String key, Long until) throws RejectedException {
        if (until == null || tables.mutes().contains(key)) {
            return;
        }
        if (tables.mutes().all().size() >= Limits.MUTES) {
            throw new RejectedException(
                    ErrorCode.QUOTA_EXCEEDED,
                    "%d subjects are muted already; unmute some, or mute all of a kind".formatted(Limits.MUTES));
        }
    }

    private Long mutedUntil(Cause cause, long now) {
        Long until = null;
        for (String each : List.of(cause.identity(), cause.subject(), ALL)) {
            AlarmTables.Mute mute = tables.mutes().get(Cause.key(cause.kind(), each));
            if (mute != null && mute.until() > now && (until == null || mute.until() > until)) {
                until = mute.until();
            }
        }
        return until;
    }

    @Override
    public void passTime(long now) {
        for (Alarm alarm : current()) {
            Alarm seen = alarm.notAfter(now);
            if (seen != alarm) {
                tables.alarms().put(seen.alarm(), seen);
            }
            change(seen, AlarmStateMachine::afterTime, now);
        }
        List<Cause> beyondLimit = limit.causes(now);
        beyondLimit.forEach(cause -> report(cause, null, now));
        endOthers(
                alarm -> alarm.isOfGroup() && AlarmLimit.KINDS.contains(alarm.kind()),
                beyondLimit,
                "no causes beyond the limit",
                now);
        if (Elapsed.hasPassed(CLEARING_INTERVAL, cleared, now)) {
            cleared = now;
            clear(now);
        }
    }

    private void clear(long now) {
        List<Alarm> closed = tables.alarms().where(alarm -> alarm.state() == AlarmState.CLOSED);
        closed.sort(Comparator.comparingLong((Alarm alarm) -> alarm.period().changed())
                .reversed());
        for (int i = 0; i < closed.size(); i++) {
            if (i >= MAX_CLOSED || closed.get(i).period().changed() + CLOSED_RETENTION.toMillis() <= now) {
                tables.alarms().put(closed.get(i).alarm(), null);
                publisher.put(Topics.ALARMS, closed.get(i).alarm(), null);
            }
        }
        tables.mutes()
                .where(mute -> mute.notAfter(now) != mute)
                .forEach(mute -> tables.mutes().put(mute.key(), mute.notAfter(now)));
        tables.mutes()
                .where(mute -> mute.until() <= now)
                .forEach(mute -> tables.mutes().put(mute.key(), null));
    }

    /** Returns the alarm that is not closed; null if none. */
    private Alarm current(AlarmKind kind, String identity) {
        String existing = AlarmLimit.find(tables.current(), kind, identity);
        return existing == null ? null : tables.alarms().get(existing);
    }

    /** Returns a copy, because the store changes during the iteration. */
    private List<Alarm> current() {
        return tables.current().all().stream().map(tables.alarms()::get).toList();
    }

    private void change(Alarm alarm, AlarmStateMachine.Event event, long now) {
        Alarm next = apply(alarm, event, now);
        if (next != alarm) {
            store(next.numbered(sequence.next()));
        }
    }

    private static Alarm apply(Alarm alarm, AlarmStateMachine.Event event, long now) {
        try {
            return event.next(alarm, now);
        } catch (RejectedException e) {
            throw new IllegalStateException(
                    "an alarm that is not closed accepts every event except commands of users", e);
        }
    }

    private void store(Alarm alarm) {
        boolean existing = tables.alarms().get(alarm.alarm()) != null;
        boolean closed = alarm.state() == AlarmState.CLOSED;
        if (!existing || closed) {
            limit.changed(alarm, closed ? -1 : 1);
        }
        tables.alarms().put(alarm.alarm(), alarm);
        tables.current().put(alarm.key(), closed ? null : alarm.alarm());
        publisher.put(Topics.ALARMS, alarm.alarm(), alarm.toBytes());
    }
}
