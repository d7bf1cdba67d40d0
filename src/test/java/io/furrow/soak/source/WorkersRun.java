package io.furrow.soak.source;

import java.io.IOException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;

import io.furrow.soak.control.Until;
import io.furrow.soak.source.NotificationTap.Try;
import io.furrow.soak.source.SourceGroup.Member;
import io.furrow.soak.source.SourceWorkers.Outcome;
import io.furrow.soak.source.WorkerGauges.Shown;

/** What happens to the workers of a source in a round, and what is compared then. */
final class WorkersRun implements AutoCloseable {
    /** A task beside others looks for journals after 5 s, and every 10 s from then on. */
    private static final Duration ADOPTION_TIMEOUT = Duration.ofSeconds(60);

    private static final Duration TIMEOUT = Duration.ofSeconds(120);

    private final WorkersFarm farm;
    private final SourceGroup group;
    private final boolean exactlyOnce;
    private final PlantedFault fault;
    private long left;
    private long unshown;
    private int unavailable;
    private Member second;

    private WorkersRun(WorkersFarm farm, boolean exactlyOnce, PlantedFault fault) {
        this.farm = farm;
        this.group = farm.group;
        this.exactlyOnce = exactlyOnce;
        this.fault = fault;
    }

    /** Returns when the tasks are notified. */
    static WorkersRun start(Path folder, int perSecond, boolean exactlyOnce, PlantedFault fault) throws IOException {
        WorkersRun run = new WorkersRun(WorkersFarm.start(folder, perSecond, exactlyOnce), exactlyOnce, fault);
        try {
            run.begin();
            return run;
        } catch (RuntimeException | IOException e) {
            run.close();
            throw e;
        }
    }

    private void begin() throws IOException {
        group.join("worker-1", "disk-1");
        second = group.join("worker-2", "disk-2");
        farm.subscribe();
        load("two workers");
        if (fault == PlantedFault.LOSE || fault == PlantedFault.REPEAT) {
            farm.tap.plant(fault);
        }
    }

    /** All that can happen to workers, once. */
    void round(int round) throws IOException, InterruptedException {
        Away third = joinAndStop("worker-3." + round);
        killAndRestart();
        Away removed = remove();
        Member fourth = group.join("worker-4." + round, "disk-3");
        group.awaitTasks();
        load("another worker came, with the disk of the one that was stopped");
        comeBack(fourth, third);
        comeBack(removed, "worker-2." + round);
        farm.quiet();
        group.stop(fourth);
        group.awaitTasks();
        unavailable(fourth, UndeliveredRecords.records(fourth.process().log()));
        load("the other one was emptied and stopped");
    }

    /** A worker is removed, and another one comes with its disk. */
    void removeAndComeBack() throws IOException, InterruptedException {
        comeBack(remove(), "worker-2.1");
    }

    private void load(String when) {
        left = Math.max(left, farm.load(when));
    }

    /**
     * What is on the disk of a worker that is no more.
     *
     * @param shown records that it told of last
     * @param missing changes that it acknowledged and that are not in Kafka; records of the repair come on top
     */
    private record Away(Member worker, long shown, List<NumberedChange> missing) {}

    /** A task moves while its journal holds what is not in Kafka: a worker that has it no more must show that. */
    private Away joinAndStop(String name) throws IOException {
        group.pause();
        load("paused");
        long held = held(List.of());
        Member third = group.join(name, "disk-3");
        Until.isTrue("a worker shows what the task that moved away left", TIMEOUT, () -> {
            long shown = group.shown().values().stream()
                    .mapToLong(Shown::leftRecords)
                    .sum();
            left = Math.max(left, shown);
            return shown > 0;
        });
        compareReported("a third worker joined", held);
        farm.changes.goOn();
        group.resume();
        group.awaitTasks();
        load("a third worker joined and took a task");
        group.stop(third);
        group.awaitTasks();
        load("the third worker stopped in order");
        farm.quiet();
        return unavailable(third, UndeliveredRecords.records(third.process().log()));
    }

    private void killAndRestart() throws IOException, InterruptedException {
        farm.changes.goOn();
        group.kill(second);
        group.restart(second);
        group.awaitTasks();
        load("the second worker killed and started again");
        farm.quiet();
    }

    /** Kills the second worker while its journals hold what is not in Kafka. */
    private Away remove() throws IOException, InterruptedException {
        group.pause();
        load("paused, so that journals fill");
        compareReported("before a worker is removed", held(group.departed()));
        long shown = second.gauges().read().onDisk();
        group.kill(second);
        farm.changes.goOn();
        group.resume();
        group.awaitTasks();
        load("the second worker removed");
        farm.quiet();
        Away removed = unavailable(second, shown);
        if (fault == PlantedFault.TAKE_JOURNAL) {
            UndeliveredRecords.deleteJournals(second.disk());
        }
        return removed;
    }

    private void comeBack(Away removed, String name) throws IOException {
        farm.changes.goOn();
        second = group.join(name, "disk-2");
        group.awaitTasks();
        load("another worker came, with the disk of the removed one");
        comeBack(second, removed);
    }

    /** Acknowledged changes that are on the disks of the workers that run, and not in Kafka; nothing changes any more. */
    private long held(List<Member> departed) {
        farm.awaitAnswers();
        farm.topic.read();
        return farm.missing().stream()
                .filter(change -> departed.stream().noneMatch(member -> farm.isAt(member, change)))
                .count();
    }

    /** Several looks are no single moment: they count once two in a row agree. Records of the repair are shown as well. */
    private void compareReported(String when, long held) {
        long[] before = {-1};
        Until.isTrue("the workers show the same twice", TIMEOUT, () -> {
            long shown =
                    group.shown().values().stream().mapToLong(Shown::onDisk).sum();
            boolean same = shown == before[0];
            before[0] = shown;
            return same;
        });
        unshown += Math.max(0, held - before[0]);
        System.out.printf("  %s: %d notified records are not in Kafka, %d in all are shown%n", when, held, before[0]);
    }

    /** What is missing while the others are drained must be on the disk that is away, as was shown. */
    private Away unavailable(Member departed, long shown) {
        List<NumberedChange> missing = farm.missing().stream()
                .filter(change -> farm.isAt(departed, change))
                .toList();
        unavailable += missing.size();
        unshown += Math.max(0, missing.size() - shown);
        System.out.printf(
                "  away with %s: %d notified records; %d in all were shown%n", departed, missing.size(), shown);
        return new Away(departed, shown, missing);
    }

    /** The disk is here again: the worker takes as many records from it as were shown, and all come to Kafka. */
    private void comeBack(Member worker, Away removed) {
        Until.within(ADOPTION_TIMEOUT, () -> worker.gauges().read().recovered() >= removed.shown());
        farm.quiet();
        long recovered = worker.gauges().read().recovered();
        long came = removed.missing().stream()
                .filter(change -> farm.topic.notified(change) > 0)
                .count();
        boolean wrong = exactlyOnce ? recovered != removed.shown() : recovered < removed.shown();
        unshown += wrong ? Math.abs(recovered - removed.shown()) : 0;
        System.out.printf(
                "  back with %s: %d of %d notified records; %d records were on the disk, %d were shown%n",
                worker, came, removed.missing().size(), recovered, removed.shown());
    }

    /** After the last round. */
    Outcome outcome() {
        farm.quiet();
        int doubled = 0;
        int acknowledged = 0;
        for (NumberedChange change : farm.tap.changes()) {
            List<Try> tries = farm.tap.tries(change);
            doubled += Math.max(0, farm.topic.notified(change) - tries.size());
            acknowledged += tries.stream().anyMatch(Try::isAcknowledged) ? 1 : 0;
        }
        System.out.printf(
                "%d of %d entities have an older record behind their newest; offsets of %d journals%n",
                farm.topic.lastIsOlder(), WorkersFarm.ENTITIES, group.journalsInOffsets());
        return new Outcome(
                acknowledged,
                farm.missing().size(),
                doubled,
                farm.topic.differentIds(),
                farm.topic.notNewest(farm.changes.newest()).size(),
                unshown,
                left,
                unavailable,
                farm.topic.repaired());
    }

    @Override
    public void close() {
        farm.close();
    }
}
