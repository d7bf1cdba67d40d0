package io.furrow.bench.replay;

import java.util.ArrayList;
import java.util.BitSet;
import java.util.List;
import java.util.Locale;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;
import java.util.function.Function;
import java.util.stream.Stream;

import io.furrow.bench.frame.Figures;
import io.furrow.bench.frame.TopicFiller;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.topic.Topics;

/**
 * Replays one mission as fast as possible, by the job and by a bare loop alternately: a cursor of MongoDB's driver by
 * event time, whose documents are decoded, turned into records and sent by a producer with the job's settings. The loop
 * does so twice: with queries as large as the job's, and with one query.
 */
final class MaxMeasurement {
    private static final int PER_SECOND = 1_000;
    private static final int WARM_UP_EVENTS = 50_000;
    private static final double NANOS = 1e9;
    private static final double MILLIS = 1_000;

    private final ReplayCluster cluster;
    private final StoredMission mission;
    private final Consumer<String> progress;

    /**
     * The result of either in one turn.
     *
     * @param perSecond events, between the first and the last on the topic
     * @param seconds from the request, or the loop's beginning, to the last
     */
    private record Run(double perSecond, double seconds, long missing) {}

    private record Turn(Run replay, Run parts, Run whole) {}

    MaxMeasurement(ReplayCluster cluster, int events, Consumer<String> progress) {
        this.cluster = cluster;
        this.mission = new StoredMission("max", events, PER_SECOND, 1);
        this.progress = progress;
    }

    /** @return whether every event was written */
    boolean run(int count, Consumer<Figures> out) throws Exception {
        progress.accept("%,d events into MongoDB".formatted(mission.events()));
        mission.store(cluster.mongo());
        List<Turn> turns = new ArrayList<>();
        for (int turn = 0; turn <= count; turn++) {
            int events = turn == 0 ? Math.min(WARM_UP_EVENTS, mission.events()) : mission.events();
            Turn measured = new Turn(
                    replay(3 * turn, events),
                    bare(3 * turn + 1, events, BaselineCursor.FIRST_QUERY),
                    bare(3 * turn + 2, events, mission.events()));
            progress.accept(String.format(
                    Locale.ROOT,
                    "%s  replay %,9.0f/s   bare loop in parts %,9.0f/s   bare loop %,9.0f/s",
                    turn == 0 ? "warm-up" : "turn " + turn,
                    measured.replay().perSecond(),
                    measured.parts().perSecond(),
                    measured.whole().perSecond()));
            if (turn > 0) {
                turns.add(measured);
            }
        }
        out.accept(figures(turns));
        return turns.stream()
                .flatMap(turn -> Stream.of(turn.replay(), turn.parts(), turn.whole()))
                .allMatch(run -> run.missing() == 0);
    }

    /** Replays it once. @return the greatest growth of the heap in use, after collections, MiB */
    long heldWhilePlayed() throws Exception {
        mission.store(cluster.mongo());
        try (HeapGrowth heap = HeapGrowth.start(progress)) {
            Run run = replay(0, mission.events());
            progress.accept(String.format(
                    Locale.ROOT, "%,d events in %.1f s, %d missing", mission.events(), run.seconds(), run.missing()));
            return heap.most();
        }
    }

    private Run replay(int number, int events) throws Exception {
        Long to = events == mission.events() ? null : Long.valueOf(StoredMission.BEGIN + events * 1_000L / PER_SECOND);
        ReplayPlan part =
                new ReplayPlan(null, null, to, false, List.of(), null, ReplayPlan.Stamps.ORIGINAL, null, List.of());
        DesiredReplay desired = desired(number, part);
        long asked = System.currentTimeMillis();
        cluster.play(List.of(desired));
        return run(desired.topic(), asked, to == null ? events : -1);
    }

    private DesiredReplay desired(int number, ReplayPlan part) {
        String topic = Topics.replay(mission.name(), "%08x".formatted(number));
        return DesiredReplay.started(mission.name(), topic, part, ReplayCommand.MAX, 0, 1);
    }

    private Run bare(int number, int events, int perQuery) throws Exception {
        DesiredReplay replay = desired(number, ReplayPlan.PLAIN);
        cluster.make(List.of(replay.topic()));
        long begun = System.currentTimeMillis();
        try (TopicFiller producer = cluster.producer()) {
            new BaselineCursor(cluster.mongo(), replay, events, perQuery).write(producer);
        }
        return run(replay.topic(), begun, events);
    }

    /** @param expected −1 if unknown */
    private Run run(String topic, long asked, int expected) throws Exception {
        BitSet found = new BitSet();
        long[] appended = {Long.MAX_VALUE, Long.MIN_VALUE};
        cluster.read(List.of(topic), (name, event) -> {
            found.set((int) event.sequence());
            appended[0] = Math.min(appended[0], event.appended());
            appended[1] = Math.max(appended[1], event.appended());
        });
        cluster.delete(List.of(topic));
        int count = found.cardinality();
        double seconds = TimeUnit.MILLISECONDS.toNanos(appended[1] - appended[0]) / NANOS;
        return new Run(count / seconds, (appended[1] - asked) / MILLIS, expected < 0 ? 0 : expected - count);
    }

    private Figures figures(List<Turn> turns) {
        Figures figures =
                new Figures("One mission of %,d events at speed max, medians of %d turns; a checkpoint every %d ms"
                        .formatted(mission.events(), turns.size(), cluster.checkpointMillis()));
        add(figures, "replay", turns, Turn::replay);
        add(figures, "bare, in parts", turns, Turn::parts);
        add(figures, "bare loop", turns, Turn::whole);
        return figures;
    }

    private static void add(Figures figures, String who, List<Turn> turns, Function<Turn, Run> which) {
        List<Run> runs = turns.stream().map(which).toList();
        figures.add(
                "by", who,
                "events/s", Figures.median(runs, Run::perSecond),
                "of in parts",
                        Figures.median(
                                turns,
                                turn -> which.apply(turn).perSecond()
                                        / turn.parts().perSecond()),
                "of bare",
                        Figures.median(
                                turns,
                                turn -> which.apply(turn).perSecond()
                                        / turn.whole().perSecond()),
                "seconds", Figures.median(runs, Run::seconds),
                "missing", runs.stream().mapToLong(Run::missing).sum());
    }
}
