package io.furrow.control.alarm;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import io.furrow.control.manager.Desk;
import io.furrow.control.manager.Outbox;
import io.furrow.control.manager.Sequence;
import io.furrow.model.control.AlarmCommand;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RefusedException;
import io.furrow.model.control.Response;
import io.furrow.model.topic.Topics;

/**
 * Raises alarms, takes them through their life as causes and people say, and keeps {@code service.alarms}: of a kind and subject
 * there is one that is not closed. A closed one is kept for a day, then taken away.
 */
public final class AlarmDesk implements Desk<AlarmCommand> {
    static final Duration CLOSED_KEPT = Duration.ofDays(1);

    private static final long CLEARING_EVERY = Duration.ofMinutes(1).toMillis();
    private static final String ALL = "";

    private final AlarmRecords records;
    private final Sequence sequence;
    private final Outbox outbox;
    private long nextClearing;

    AlarmDesk(AlarmRecords records, Sequence sequence, Outbox outbox) {
        this.records = records;
        this.sequence = sequence;
        this.outbox = outbox;
    }

    /** Raises an alarm, or takes note that one is right still. */
    public void raise(Cause cause, long now) {
        String known = records.current().get(cause.key());
        if (known == null) {
            keep(Alarm.raised(cause, mutedUntil(cause.kind(), cause.subject(), now), sequence.next(), now));
        } else {
            Alarm alarm = records.alarms().get(known);
            records.alarms().put(known, sure(alarm, new AlarmEvent.Repeated(cause.until(now)), now));
        }
    }

    /** Closes the alarm of a kind and subject where there is one. */
    public void end(AlarmKind kind, String subject, String reason, long now) {
        String known = records.current().get(Cause.key(kind, subject));
        if (known != null) {
            change(records.alarms().get(known), new AlarmEvent.Ended(reason), now);
        }
    }

    @Override
    public Response answer(AlarmCommand command, long now) throws RefusedException {
        if (command instanceof AlarmCommand.Acknowledge acknowledge) {
            return answer(acknowledge.alarm(), new AlarmEvent.Acknowledged(acknowledge.user()), "acknowledged", now);
        } else if (command instanceof AlarmCommand.Close close) {
            String by = close.user() == null ? "somebody" : close.user();
            return answer(close.alarm(), new AlarmEvent.Ended("closed by " + by), "closed", now);
        } else if (command instanceof AlarmCommand.Mute mute) {
            long until = now + mute.time().toMillis();
            return muted(mute.target(), until, now).with("until", until);
        }
        return muted(((AlarmCommand.Unmute) command).target(), null, now);
    }

    private Response answer(String id, AlarmEvent event, String status, long now) throws RefusedException {
        Alarm alarm = records.alarms().get(id);
        if (alarm == null) {
            throw new RefusedException(
                    ErrorCode.UNKNOWN_ALARM, "there is no alarm '%s', or it was closed long ago".formatted(id));
        }
        Alarm next = AlarmLife.next(alarm, event, now);
        if (next != alarm) {
            keep(next.numbered(sequence.next()));
        }
        return Response.of(status).with(AlarmCommand.ALARM, id);
    }

    /** @param until null for not any more */
    private Response muted(AlarmCommand.Target target, Long until, long now) throws RefusedException {
        AlarmEvent event = until == null ? new AlarmEvent.Unmuted() : new AlarmEvent.Muted(until);
        String status = until == null ? "unmuted" : "muted";
        if (target instanceof AlarmCommand.OfAlarm of) {
            return answer(of.alarm(), event, status, now);
        }
        AlarmCommand.OfKind of = (AlarmCommand.OfKind) target;
        String key = Cause.key(of.kind(), of.subject() == null ? ALL : of.subject());
        records.mutes().put(key, until == null ? null : new AlarmRecords.Mute(key, until));
        for (Alarm alarm : current()) {
            if (alarm.kind() == of.kind()
                    && (of.subject() == null || of.subject().equals(alarm.subject()))) {
                change(alarm, event, now);
            }
        }
        return Response.of(status).with("kind", of.kind().code()).with("subject", of.subject());
    }

    private Long mutedUntil(AlarmKind kind, String subject, long now) {
        Long until = null;
        for (String each : List.of(subject, ALL)) {
            AlarmRecords.Mute mute = records.mutes().get(Cause.key(kind, each));
            if (mute != null && mute.until() > now && (until == null || mute.until() > until)) {
                until = mute.until();
            }
        }
        return until;
    }

    @Override
    public void passTime(long now) {
        for (Alarm alarm : current()) {
            change(alarm, new AlarmEvent.TimePassed(), now);
        }
        if (now >= nextClearing) {
            nextClearing = now + CLEARING_EVERY;
            clear(now);
        }
    }

    private void clear(long now) {
        List<String> over = new ArrayList<>();
        records.alarms().forEach(alarm -> {
            if (alarm.state() == AlarmState.CLOSED && alarm.changed() + CLOSED_KEPT.toMillis() <= now) {
                over.add(alarm.alarm());
            }
        });
        for (String id : over) {
            records.alarms().put(id, null);
            outbox.put(Topics.ALARMS, id, null);
        }
        List<String> passed = new ArrayList<>();
        records.mutes().forEach(mute -> {
            if (mute.until() <= now) {
                passed.add(mute.key());
            }
        });
        passed.forEach(key -> records.mutes().put(key, null));
    }

    /** A list, because the records change while one goes through it. */
    private List<Alarm> current() {
        List<Alarm> current = new ArrayList<>();
        records.current().forEach(id -> current.add(records.alarms().get(id)));
        return current;
    }

    private void change(Alarm alarm, AlarmEvent event, long now) {
        Alarm next = sure(alarm, event, now);
        if (next != alarm) {
            keep(next.numbered(sequence.next()));
        }
    }

    private static Alarm sure(Alarm alarm, AlarmEvent event, long now) {
        try {
            return AlarmLife.next(alarm, event, now);
        } catch (RefusedException e) {
            throw new IllegalStateException("an alarm that is not closed takes all but a second acknowledgement", e);
        }
    }

    private void keep(Alarm alarm) {
        records.alarms().put(alarm.alarm(), alarm);
        records.current().put(alarm.key(), alarm.state() == AlarmState.CLOSED ? null : alarm.alarm());
        outbox.put(Topics.ALARMS, alarm.alarm(), alarm.toBytes());
    }
}
