package io.furrow.bench.replay;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;
import java.util.stream.IntStream;

import io.furrow.bench.frame.Figures;
import io.furrow.bench.frame.TopicFiller;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.topic.Topics;

/**
 * Replays missions at speed 1 by the job, and writes the same records to the same schedule by a bare loop, alternately.
 * A single replay begins at a time set beforehand; several begin as soon as the job can, and the loop uses the
 * beginnings of the job.
 */
final class TimingMeasurement {
    /** The length of a warm-up turn. */
    private static final int WARM_UP_SECONDS = 10;

    private static final int MAX_MISSIONS = 20;
    private static final int START_SECONDS = 5;
    private static final long AHEAD_MILLIS = 3_000;
    private static final int MILLIS = 1_000;

    private final ReplayCluster cluster;
    private final int seconds;
    private final int replays;
    private final int perSecond;
    private final List<StoredMission> missions;
    private final Consumer<String> progress;

    private record Turn(Timing replay, Timing bare, long[] untilFirst) {}

    /** @param perSecond events of each replay */
    TimingMeasurement(ReplayCluster cluster, int replays, int perSecond, int seconds, Consumer<String> progress) {
        this.cluster = cluster;
        this.seconds = seconds;
        this.replays = replays;
        this.perSecond = perSecond;
        this.progress = progress;
        this.missions = IntStream.range(0, Math.min(replays, MAX_MISSIONS))
                .mapToObj(number -> new StoredMission(
                        "timing-%d-%d".formatted(replays, number), perSecond * seconds, perSecond, number))
                .toList();
    }

    /** @return whether every event was written */
    boolean run(int count, Consumer<Figures> out) throws Exception {
        missions.forEach(mission -> mission.store(cluster.mongo()));
        List<Turn> turns = new ArrayList<>();
        for (int turn = 0; turn <= count; turn++) {
            Turn measured = turn(turn);
            progress.accept("%s  replay: %s, bare loop: %s"
                    .formatted(
                            turn == 0 ? "warm-up" : "turn " + turn,
                            measured.replay().steady(),
                            measured.bare().steady()));
            if (turn > 0) {
                turns.add(measured);
            }
        }
        out.accept(figures(turns));
        return turns.stream()
                .allMatch(turn -> turn.replay().missing() == 0 && turn.bare().missing() == 0);
    }

    /** Replays them once. @return the greatest growth of the heap in use, after collections, MiB */
    long heldWhilePlayed() throws Exception {
        missions.forEach(mission -> mission.store(cluster.mongo()));
        try (HeapGrowth heap = HeapGrowth.start(progress)) {
            List<DesiredReplay> desired = desired(0, Long.MAX_VALUE, null);
            cluster.play(desired);
            return heap.most();
        }
    }

    private Turn turn(int number) throws Exception {
        long until = number == 0 ? StoredMission.BEGIN + WARM_UP_SECONDS * MILLIS : Long.MAX_VALUE;
        Long startAt = replays > 1 ? null : Long.valueOf(System.currentTimeMillis() + AHEAD_MILLIS);
        List<DesiredReplay> desired = desired(2 * number, until, startAt);
        long asked = System.currentTimeMillis();
        cluster.play(desired);
        Timing.Collected played = collected();
        List<ScheduledReplay> schedule = new ArrayList<>();
        long[] untilFirst = new long[replays];
        Map<String, List<PlayedRecord>> onTopics = ScheduledReplay.events(cluster, desired);
        for (int i = 0; i < replays; i++) {
            StoredMission mission = missions.get(i % missions.size());
            List<PlayedRecord> events = onTopics.get(desired.get(i).topic());
            long anchor = startAt == null ? events.get(0).handedOver() : startAt;
            schedule.add(new ScheduledReplay(desired.get(i), mission, anchor));
            played.add(schedule.get(i), events, expected(mission, until));
            untilFirst[i] = events.get(0).appended() - asked;
        }
        Arrays.sort(untilFirst);
        return new Turn(played.timing(), bare(number, schedule, until), untilFirst);
    }

    private Timing.Collected collected() {
        return new Timing.Collected(replays > 1 ? (long) START_SECONDS * MILLIS : 0);
    }

    private Timing bare(int number, List<ScheduledReplay> schedule, long until) throws Exception {
        List<DesiredReplay> others = desired(2 * number + 1, until, null);
        List<String> topics = others.stream().map(DesiredReplay::topic).toList();
        cluster.make(topics);
        long first = schedule.stream()
                .min(Comparator.comparingLong(ScheduledReplay::anchor))
                .orElseThrow()
                .anchor();
        List<ScheduledReplay> again;
        try (TopicFiller producer = cluster.producer()) {
            producer.learn(topics); // a running job has these already
            long later = System.currentTimeMillis() + AHEAD_MILLIS - first;
            again = IntStream.range(0, replays)
                    .mapToObj(i -> schedule.get(i).onto(others.get(i), later))
                    .toList();
            new BaselineSchedule(again, until).write(producer);
        }
        Timing.Collected written = collected();
        Map<String, List<PlayedRecord>> onTopics = ScheduledReplay.events(cluster, others);
        for (ScheduledReplay replay : again) {
            written.add(replay, onTopics.get(replay.replay().topic()), expected(replay.mission(), until));
        }
        return written.timing();
    }

    private List<DesiredReplay> desired(int number, long until, Long startAt) {
        Long to = until == Long.MAX_VALUE ? null : Long.valueOf(until);
        ReplayPlan stamped =
                new ReplayPlan(null, null, to, false, List.of(), null, ReplayPlan.Stamps.NOW, startAt, List.of());
        return IntStream.range(0, replays)
                .mapToObj(i -> {
                    String mission = missions.get(i % missions.size()).name();
                    String topic = Topics.replay(mission, "%08x".formatted(number * replays + i));
                    return DesiredReplay.started(mission, topic, stamped, 1, 0, 1);
                })
                .toList();
    }

    private static long expected(StoredMission mission, long until) {
        return mission.all().stream().filter(event -> event.time() < until).count();
    }

    private Figures figures(List<Turn> turns) {
        Figures figures = new Figures(
                "%d at once, %d events/s each for %d s at speed 1, ms behind schedule, medians of %d turns; a checkpoint every %d ms"
                        .formatted(replays, perSecond, seconds, turns.size(), cluster.checkpointMillis()));
        add(figures, "replay", turns.stream().map(Turn::replay).toList());
        add(figures, "bare loop", turns.stream().map(Turn::bare).toList());
        if (replays > 1) {
            long[] first = turns.get(turns.size() / 2).untilFirst();
            progress.accept("from the request to the first event on the topic: median %d ms, last %d ms"
                    .formatted(first[first.length / 2], first[first.length - 1]));
        }
        return figures;
    }

    private static void add(Figures figures, String who, List<Timing> turns) {
        long missing = turns.stream().mapToLong(Timing::missing).sum();
        row(figures, who, "handed over", turns.stream().map(Timing::handedOver).toList(), missing);
        row(figures, who, "appended", turns.stream().map(Timing::steady).toList(), missing);
        List<Lateness> starts =
                turns.stream().flatMap(turn -> turn.start().stream()).toList();
        if (!starts.isEmpty()) {
            row(figures, who, "first %d s".formatted(START_SECONDS), starts, missing);
        }
    }

    private static void row(Figures figures, String who, String what, List<Lateness> turns, long missing) {
        Lateness median = Lateness.median(turns);
        figures.add(
                "by", who,
                "when", what,
                "p50", median.p50(),
                "p99", median.p99(),
                "max", median.max(),
                "drift", median.drift(),
                "least", median.least(),
                "missing", missing);
    }
}
