package io.furrow.control.replay;

import java.time.Instant;
import java.util.List;
import java.util.function.UnaryOperator;

import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.DesiredReplay.Clock;
import io.furrow.model.control.DesiredReplay.Range;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RejectedException;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayCommand.Loop;
import io.furrow.model.control.ReplayCommand.Seek;
import io.furrow.model.control.ReplayCommand.Simple;
import io.furrow.model.control.ReplayCommand.Speed;
import io.furrow.model.control.ReplayCommand.Step;
import io.furrow.model.control.ReplayStatus;

/** Applies commands to replays that follow a common clock. Times are epoch ms. */
final class ReplayGroup {
    /** Delay before a clock starts, so that all players have received it. */
    static final long START_DELAY = 2000;

    private static final long DELAY = 1000;

    private final List<DesiredReplay> members;
    /** Any member, because the desired state is the same for all. */
    private final DesiredReplay representative;

    /** @param members at least one */
    ReplayGroup(List<DesiredReplay> members) {
        this.members = members;
        this.representative = members.get(0);
    }

    /** Returns the members of a new group, which starts at the beginning of their common range. */
    static List<DesiredReplay> started(List<DesiredReplay> members, String group, long now) {
        DesiredReplay representative = members.get(0);
        Long startAt = representative.plan().startAt();
        long at = Math.max(now + START_DELAY, startAt == null ? 0 : startAt);
        Clock clock = new Clock(at, representative.from(representative.plan().from()));
        return members.stream().map(each -> each.following(group, clock)).toList();
    }

    /** @throws RejectedException if a group does not support the command with these arguments */
    void check(ReplayCommand.Steering steering) throws RejectedException {
        if (steering instanceof Step) {
            throw new RejectedException(
                    ErrorCode.WRONG_STATE, "a group has no single next event; pause it and seek instead of 'step'");
        } else if (steering instanceof Speed speed && speed.speed() == ReplayCommand.MAX) {
            throw wrong("'speed' must be a number from 0.1 to 1000: a group follows a clock");
        } else if (steering instanceof Seek seek && !isWithin(seek.to().toEpochMilli())) {
            throw wrong("'to' must be at least %s and before %s, the range that the group plays"
                    .formatted(time(representative.from(representative.plan().from())), time(representative.to())));
        } else if (steering instanceof Loop loop) {
            checkRange(representative, loop.range());
        }
    }

    /**
     * Rejects a range that does not overlap the played range.
     *
     * @param replay of a group
     * @param range null for the whole range
     */
    static void checkRange(DesiredReplay replay, Range range) throws RejectedException {
        long from = replay.plan().from();
        long to = replay.plan().to();
        if (range != null && (range.from() >= to || range.to() <= from)) {
            throw wrong("'from' and 'to' must overlap the range that the group plays, from %s to %s"
                    .formatted(time(from), time(to)));
        }
    }

    private boolean isWithin(long time) {
        return time >= representative.from(representative.plan().from()) && time < representative.to();
    }

    private static Instant time(long millis) {
        return Instant.ofEpochMilli(millis);
    }

    private static RejectedException wrong(String reason) {
        return new RejectedException(ErrorCode.WRONG_MEMBER, reason);
    }

    /** Returns the desired state of all members after a valid command. @param sequence of the command */
    List<DesiredReplay> steered(ReplayCommand.Steering steering, long now, long sequence) {
        if (steering instanceof Seek seek) {
            return jumped(seek.to().toEpochMilli(), now, sequence);
        } else if (steering instanceof Speed speed) {
            return all(each -> each.at(speed.speed(), sequence), continued(now));
        } else if (steering instanceof Loop loop) {
            return looped(loop.range(), now, sequence);
        }
        return switch (((Simple) steering).what()) {
            case STOP -> all(each -> each.desired(ReplayStatus.State.STOPPED, sequence), representative.clock());
            case PAUSE ->
                all(
                        each -> each.desired(ReplayStatus.State.PAUSED, sequence),
                        new Clock(now, representative.position(now)));
            case RESUME ->
                all(
                        each -> each.desired(ReplayStatus.State.RUNNING, sequence),
                        new Clock(soon(now), representative.clock().shows()));
        };
    }

    private List<DesiredReplay> jumped(long to, long now, long sequence) {
        return all(each -> each.seeking(to, sequence), new Clock(soon(now), to));
    }

    /** Continues at the current position, or at the beginning of the range if the position is outside of it. */
    private List<DesiredReplay> looped(Range range, long now, long sequence) {
        List<DesiredReplay> within = all(each -> each.within(range, sequence), continued(now));
        ReplayGroup next = new ReplayGroup(within);
        return range == null || next.isWithin(representative.position(now))
                ? within
                : next.jumped(
                        next.representative.from(next.representative.plan().from()), now, sequence);
    }

    /** Returns a clock that continues from the current position; a clock that has not started yet retains its start. */
    private Clock continued(long now) {
        return new Clock(Math.max(now, representative.clock().at()), representative.position(now));
    }

    /** Returns a time shortly after now, but not before the start of the group. */
    private long soon(long now) {
        Long startAt = representative.plan().startAt();
        return Math.max(now + DELAY, startAt == null ? 0 : startAt);
    }

    private List<DesiredReplay> all(UnaryOperator<DesiredReplay> change, Clock clock) {
        return members.stream()
                .map(each -> change.apply(each).following(each.group(), clock))
                .toList();
    }
}
