package io.furrow.control.replay;

import java.time.Instant;
import java.util.UUID;
import java.util.function.Supplier;

import io.furrow.control.manager.Outbox;
import io.furrow.control.manager.Quota;
import io.furrow.control.manager.Records;
import io.furrow.control.manager.Sequence;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Limits;
import io.furrow.model.control.RefusedException;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.control.Response;
import io.furrow.model.topic.Topics;

/**
 * Grants or refuses what is asked of replays, and says on {@code service.replays} what is wanted of them. Whether a mission has
 * anything to play back only the executor knows, which says so on {@code service.replays.status}.
 */
final class ReplayDesk {
    private static final int ID_DIGITS = 8;

    private final Records<Replay> replays;
    private final Sequence sequence;
    private final Quota quota;
    private final Supplier<UUID> ids;
    private final Outbox outbox;

    /** @param counters of the sequence, and of the room that is used */
    ReplayDesk(Records<Replay> replays, Records<Long> counters, Supplier<UUID> ids, Outbox outbox) {
        this.replays = replays;
        this.sequence = new Sequence(counters);
        this.quota = new Quota(counters, Limits.DEFINITIONS_BYTES);
        this.ids = ids;
        this.outbox = outbox;
    }

    /** @param now epoch ms */
    Response answer(ReplayCommand command, long now) throws RefusedException {
        if (command instanceof ReplayCommand.Start start) {
            return start(start, now);
        }
        ReplayCommand.Steering steering = (ReplayCommand.Steering) command;
        Replay known = replays.get(steering.replay());
        if (known == null) {
            throw new RefusedException(
                    ErrorCode.UNKNOWN_REPLAY, "there is no replay '%s', or it is over".formatted(steering.replay()));
        }
        check(steering, known);
        Replay next = next(steering, known);
        keep(known, next);
        boolean stops = next.wanted() == Replay.Wanted.STOPPED;
        return Response.of(stops ? "deleted" : next.wanted().word()).with("replay", next.replay());
    }

    private Response start(ReplayCommand.Start start, long now) throws RefusedException {
        String id8;
        do {
            id8 = ids.get().toString().substring(0, ID_DIGITS);
        } while (replays.get(start.mission() + "." + id8) != null);
        Replay replay = new Replay(
                start.mission() + "." + id8,
                start.mission(),
                Topics.replay(start.mission(), id8),
                millis(start.from()),
                millis(start.to()),
                ReplayCommand.json(start.speed()),
                start.loop(),
                start.devices(),
                Replay.Wanted.RUNNING,
                null,
                null,
                now,
                sequence.next());
        keep(null, replay);
        return Response.of("created").with("replay", replay.replay()).with("topic", replay.topic());
    }

    private static void check(ReplayCommand.Steering steering, Replay known) throws RefusedException {
        boolean needsRunning =
                steering instanceof ReplayCommand.Simple simple && simple.what() == ReplayCommand.Verb.PAUSE;
        boolean needsPaused = steering instanceof ReplayCommand.Step
                || steering instanceof ReplayCommand.Simple simple && simple.what() == ReplayCommand.Verb.RESUME;
        boolean fits = (!needsRunning || known.wanted() == Replay.Wanted.RUNNING)
                && (!needsPaused || known.wanted() == Replay.Wanted.PAUSED)
                && known.wanted() != Replay.Wanted.STOPPED;
        if (!fits) {
            throw new RefusedException(
                    ErrorCode.WRONG_STATE,
                    "replay '%s' is %s, which '%s' cannot change"
                            .formatted(known.replay(), known.wanted().word(), steering.verb()));
        }
    }

    private Replay next(ReplayCommand.Steering steering, Replay known) {
        if (steering instanceof ReplayCommand.Seek seek) {
            return known.jumping(seek.to().toEpochMilli(), sequence.next());
        } else if (steering instanceof ReplayCommand.Speed speed) {
            return known.at(speed.speed(), sequence.next());
        } else if (steering instanceof ReplayCommand.Step step) {
            return known.stepping(step.count(), sequence.next());
        }
        return switch (((ReplayCommand.Simple) steering).what()) {
            case STOP -> known.wanted(Replay.Wanted.STOPPED, sequence.next());
            case PAUSE -> known.wanted(Replay.Wanted.PAUSED, sequence.next());
            case RESUME -> known.wanted(Replay.Wanted.RUNNING, sequence.next());
        };
    }

    /**
     * Forgets a replay that is over for good, unless something was asked of it since. What is told of a replay that goes on, several
     * times a second, is not looked up.
     */
    void reported(String replay, ReplayStatus told) {
        if (!told.state().isOver() || !told.settled()) {
            return;
        }
        Replay known = replays.get(replay);
        if (known != null && told.sequence() >= known.sequence()) {
            quota.use(-known.toBytes().length);
            replays.put(replay, null);
            outbox.put(Topics.REPLAYS, replay, null);
        }
    }

    /** @param before null where there was none */
    private void keep(Replay before, Replay replay) throws RefusedException {
        byte[] value = replay.toBytes();
        if (before == null) {
            quota.replace(null, value);
        } else {
            quota.use(
                    value.length - before.toBytes().length); // whoever steers a replay is not refused for want of room
        }
        replays.put(replay.replay(), replay);
        outbox.put(Topics.REPLAYS, replay.replay(), value);
    }

    private static Long millis(Instant time) {
        return time == null ? null : Long.valueOf(time.toEpochMilli());
    }
}
