package io.furrow.replay.playback;

import java.util.ArrayList;
import java.util.List;
import java.util.Random;

import io.furrow.mission.StoredEvent;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayStatus.State;
import io.furrow.model.control.WantedReplay;

/** What is wanted of a replay, as the control plane would write it. */
final class Wishes {
    private static final double[] SPEEDS = {0.1, 0.7, 1, 2.5, 10, 333, 1000, ReplayCommand.MAX};

    private Wishes() {}

    /** @param at ms of the clock */
    record Wish(long at, WantedReplay wanted) {}

    static WantedReplay start(double speed) {
        return new WantedReplay(
                "m.0a1b2c3d",
                "m",
                "data.m.replay.0a1b2c3d",
                null,
                null,
                speed,
                false,
                List.of(),
                State.RUNNING,
                null,
                null,
                1);
    }

    static WantedReplay with(WantedReplay w, State wanted, double speed, Long seek, int steps) {
        long sequence = w.sequence() + 1;
        long total = (w.step() == null ? 0 : w.step().total()) + steps;
        return new WantedReplay(
                w.replay(),
                w.mission(),
                w.topic(),
                w.from(),
                w.to(),
                speed,
                w.loop(),
                w.devices(),
                wanted,
                seek == null ? w.seek() : new WantedReplay.Seek(seek, sequence),
                steps == 0 ? w.step() : new WantedReplay.Step(total, sequence),
                sequence);
    }

    /** Any start and any commands, the last of which ends it. */
    static List<Wish> random(Random random, List<StoredEvent> recording) {
        long first = recording.get(0).time();
        long length = recording.get(recording.size() - 1).time() - first + 1;
        WantedReplay plain = start(speed(random));
        long from = first - 1000 + random.nextLong(length + 2000);
        WantedReplay wanted = new WantedReplay(
                plain.replay(),
                plain.mission(),
                plain.topic(),
                random.nextInt(3) == 0 ? from : null,
                random.nextInt(3) == 0 ? Long.valueOf(from + 1 + random.nextLong(length)) : null,
                plain.speed(),
                random.nextInt(3) == 0,
                random.nextInt(3) == 0 ? List.of("urn:d0", "urn:d1", "urn:d2") : List.of(),
                random.nextInt(5) == 0 ? State.PAUSED : State.RUNNING,
                null,
                null,
                1);
        List<Wish> wishes = new ArrayList<>(List.of(new Wish(0, wanted)));
        long at = 0;
        for (int i = random.nextInt(15); i > 0; i--) {
            at += random.nextInt(3) == 0 ? 0 : random.nextInt(random.nextBoolean() ? 1_000 : 100_000);
            wanted = next(wanted, random, first, length);
            wishes.add(new Wish(at, wanted));
        }
        wishes.add(new Wish(at + random.nextInt(50_000), with(wanted, State.STOPPED, wanted.speed(), null, 0)));
        return wishes;
    }

    private static WantedReplay next(WantedReplay w, Random random, long first, long length) {
        return switch (random.nextInt(5)) {
            case 0 -> with(w, w.wanted() == State.PAUSED ? State.RUNNING : State.PAUSED, w.speed(), null, 0);
            case 1, 2 -> with(w, w.wanted(), w.speed(), first - 5_000 + random.nextLong(length + 10_000), 0);
            case 3 -> with(w, w.wanted(), speed(random), null, 0);
            default ->
                w.wanted() == State.PAUSED
                        ? with(w, w.wanted(), w.speed(), null, 1 + random.nextInt(20))
                        : with(w, State.PAUSED, w.speed(), null, 0);
        };
    }

    private static double speed(Random random) {
        return SPEEDS[random.nextInt(SPEEDS.length)];
    }
}
