package io.furrow.replay.playback;

import java.util.ArrayList;
import java.util.List;
import java.util.Random;

import io.furrow.mission.StoredEvent;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.control.ReplayStatus.State;

/** Generates desired states of a replay as the control plane writes them. */
final class DesiredStates {
    private static final double[] SPEEDS = {0.1, 0.7, 1, 2.5, 10, 333, 1000, ReplayCommand.MAX};

    private static final long WALL = 1_790_000_000_000L;

    private DesiredStates() {}

    /** Returns the epoch ms at a time of the clock. */
    static long wall(long now) {
        return WALL + now;
    }

    /** @param at ms of the clock */
    record DesiredState(long at, DesiredReplay desired) {}

    static DesiredReplay start(double speed) {
        return DesiredReplay.started("m", "data.m.replay.0a1b2c3d", ReplayPlan.PLAIN, speed, 0, 1);
    }

    static DesiredReplay with(DesiredReplay last, State desired, double speed, Long seek, int steps) {
        long sequence = last.sequence() + 1;
        DesiredReplay next = last.desired(desired, sequence).at(speed, sequence);
        next = seek == null ? next : next.seeking(seek, sequence);
        return steps == 0 ? next : next.stepping(steps, sequence);
    }

    /** Returns a random start and random commands, the last of which stops the replay. */
    static List<DesiredState> random(Random random, List<StoredEvent> recording) {
        long first = recording.get(0).time();
        long length = recording.get(recording.size() - 1).time() - first + 1;
        double speed = speed(random);
        long from = first - 1000 + random.nextLong(length + 2000);
        ReplayPlan plan = new ReplayPlan(
                null,
                random.nextInt(3) == 0 ? from : null,
                random.nextInt(3) == 0 ? Long.valueOf(from + 1 + random.nextLong(length)) : null,
                random.nextInt(3) == 0,
                random.nextInt(3) == 0 ? List.of("urn:d0", "urn:d1", "urn:d2") : List.of(),
                random.nextInt(3) == 0 ? Long.valueOf(1 + random.nextInt(20_000)) : null,
                ReplayPlan.Stamps.values()[random.nextInt(5) == 0 ? 1 : 0],
                random.nextInt(5) == 0 ? Long.valueOf(WALL - 5_000 + random.nextInt(50_000)) : null,
                List.of());
        DesiredReplay desired = DesiredReplay.started("m", "data.m.replay.0a1b2c3d", plan, speed, 0, 1)
                .desired(random.nextInt(5) == 0 ? State.PAUSED : State.RUNNING, 1);
        List<DesiredState> desiredStates = new ArrayList<>(List.of(new DesiredState(0, desired)));
        long at = 0;
        for (int i = random.nextInt(15); i > 0; i--) {
            at += random.nextInt(3) == 0 ? 0 : random.nextInt(random.nextBoolean() ? 1_000 : 100_000);
            desired = next(desired, random, first, length);
            desiredStates.add(new DesiredState(at, desired));
        }
        desiredStates.add(
                new DesiredState(at + random.nextInt(50_000), with(desired, State.STOPPED, desired.speed(), null, 0)));
        return desiredStates;
    }

    /** Returns the same for a member of a group, with a clock that matches the times of the commands. */
    static List<DesiredState> ofGroup(Random random, List<StoredEvent> recording) {
        long first = recording.get(0).time();
        long length = recording.get(recording.size() - 1).time() - first + 1;
        ReplayPlan plan = new ReplayPlan(
                null,
                first - random.nextInt(2_000),
                first + length + random.nextInt(2_000),
                random.nextInt(3) == 0,
                List.of(),
                null,
                ReplayPlan.Stamps.ORIGINAL,
                null,
                List.of());
        DesiredReplay desired = DesiredReplay.started("m", "data.m.replay.0a1b2c3d", plan, groupSpeed(random), 0, 1)
                .following("0a1b2c3d", new DesiredReplay.Clock(wall(2_000), plan.from()));
        List<DesiredState> desiredStates = new ArrayList<>(List.of(new DesiredState(0, desired)));
        long at = 0;
        for (int i = random.nextInt(15); i > 0; i--) {
            at += random.nextInt(random.nextBoolean() ? 1_000 : 30_000);
            desired = nextOfGroup(desired, random, at);
            desiredStates.add(new DesiredState(at, desired));
        }
        desiredStates.add(new DesiredState(at + 10_000, with(desired, State.STOPPED, desired.speed(), null, 0)));
        return desiredStates;
    }

    private static DesiredReplay nextOfGroup(DesiredReplay last, Random random, long at) {
        long position = last.position(wall(at));
        var running = new DesiredReplay.Clock(Math.max(wall(at), last.clock().at()), position);
        return switch (random.nextInt(4)) {
            case 0 ->
                last.desired() == State.PAUSED
                        ? follow(
                                with(last, State.RUNNING, last.speed(), null, 0),
                                wall(at) + 1_000,
                                last.clock().shows())
                        : follow(with(last, State.PAUSED, last.speed(), null, 0), wall(at), position);
            case 1 -> follow(with(last, last.desired(), groupSpeed(random), null, 0), running.at(), running.shows());
            default -> {
                long to = last.plan().from()
                        + random.nextLong(last.plan().to() - last.plan().from());
                yield follow(with(last, last.desired(), last.speed(), to, 0), wall(at) + 1_000, to);
            }
        };
    }

    private static DesiredReplay follow(DesiredReplay last, long at, long shows) {
        return last.following(last.group(), new DesiredReplay.Clock(at, shows));
    }

    private static double groupSpeed(Random random) {
        return SPEEDS[random.nextInt(SPEEDS.length - 1)];
    }

    private static DesiredReplay next(DesiredReplay last, Random random, long first, long length) {
        return switch (random.nextInt(6)) {
            case 0 -> with(last, last.desired() == State.PAUSED ? State.RUNNING : State.PAUSED, last.speed(), null, 0);
            case 1, 2 -> with(last, last.desired(), last.speed(), first - 5_000 + random.nextLong(length + 10_000), 0);
            case 3 -> with(last, last.desired(), speed(random), null, 0);
            case 4 -> last.within(range(random, first, length), last.sequence() + 1);
            default ->
                last.desired() == State.PAUSED
                        ? with(
                                last,
                                last.desired(),
                                last.speed(),
                                null,
                                random.nextInt(20) + (random.nextBoolean() ? 1 : -20))
                        : with(last, State.PAUSED, last.speed(), null, 0);
        };
    }

    /** Returns a random range, or null. */
    private static DesiredReplay.Range range(Random random, long first, long length) {
        long from = first - 1_000 + random.nextLong(length + 1_000);
        return random.nextInt(3) == 0
                ? null
                : new DesiredReplay.Range(from, from + 1 + random.nextLong(random.nextBoolean() ? 5_000 : length));
    }

    private static double speed(Random random) {
        return SPEEDS[random.nextInt(SPEEDS.length)];
    }
}
