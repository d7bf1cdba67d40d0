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

/** Runs the rounds of {@link SourceWorkers} and collects the differences. */
final class WorkersRun implements AutoCloseable {
    /** A task beside others searches for orphaned journals after 5 s, and every 10 s from then on. */
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

    /** Returns once the tasks receive notifications. */
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
            farm.tap.insertFault(fault);
        }
    }

    /** Adds, stops, kills and removes workers, once each. */
    void round(int round) throws IOException, InterruptedException {
        RemovedDisk third = joinAndStop("worker-3." + round);
        killAndRestart();
        RemovedDisk removed = remove();
        Member fourth = group.join("worker-4." + round, "disk-3");
        group.awaitTasks();
        load("a new worker has the disk of the stopped one");
        checkReused(fourth, third);
        reuseDisk(removed, "worker-2." + round);
        farm.awaitQuiet();
        group.stop(fourth);
        group.awaitTasks();
        checkRemoved(fourth, UndeliveredRecords.records(fourth.process().log()));
        load("the other one was emptied and stopped");
    }

    /** Removes a worker, and starts another one with its disk. */
    void removeAndReuseDisk() throws IOException, InterruptedException {
        reuseDisk(remove(), "worker-2.1");
    }

    private void load(String when) {
        left = Math.max(left, farm.load(when));
    }

    /**
     * The disk of a removed worker.
     *
     * @param shown records in its last gauges
     * @param missing changes that it acknowledged and that are not in Kafka; the disk may also have records of the
     *     repair
     */
    private record RemovedDisk(Member worker, long shown, List<NumberedChange> missing) {}

    /** Moves a task while its journal has records that are not in Kafka: its former worker must show them. */
    private RemovedDisk joinAndStop(String name) throws IOException {
        group.pause();
        load("paused");
        long undelivered = undelivered(List.of());
        Member third = group.join(name, "disk-3");
        Until.isTrue("a worker reports the records that the moved task left", TIMEOUT, () -> {
            long shown = group.shown().values().stream()
                    .mapToLong(Shown::leftRecords)
                    .sum();
            left = Math.max(left, shown);
            return shown > 0;
        });
        compareReported("a third worker joined", undelivered);
        farm.changes.resume();
        group.resume();
        group.awaitTasks();
        load("a third worker joined and took a task");
        group.stop(third);
        group.awaitTasks();
        load("the third worker stopped in order");
        farm.awaitQuiet();
        return checkRemoved(third, UndeliveredRecords.records(third.process().log()));
    }

    private void killAndRestart() throws IOException, InterruptedException {
        farm.changes.resume();
        group.kill(second);
        group.restart(second);
        group.awaitTasks();
        load("the second worker killed and started again");
        farm.awaitQuiet();
    }

    /** Kills the second worker while its journals have records that are not in Kafka. */
    private RemovedDisk remove() throws IOException, InterruptedException {
        group.pause();
        load("paused, so that journals fill");
        compareReported("before a worker is removed", undelivered(group.departed()));
        long shown = second.gauges().read().onDisk();
        group.kill(second);
        farm.changes.resume();
        group.resume();
        group.awaitTasks();
        load("the second worker removed");
        farm.awaitQuiet();
        RemovedDisk removed = checkRemoved(second, shown);
        if (fault == PlantedFault.TAKE_JOURNAL) {
            UndeliveredRecords.deleteJournals(second.disk());
        }
        return removed;
    }

    private void reuseDisk(RemovedDisk removed, String name) throws IOException {
        farm.changes.resume();
        second = group.join(name, "disk-2");
        group.awaitTasks();
        load("a new worker has the disk of the removed one");
        checkReused(second, removed);
    }

    /** Pauses changes, and counts acknowledged changes that are not in Kafka but on disks of running workers. */
    private long undelivered(List<Member> departed) {
        farm.awaitAnswers();
        farm.topic.read();
        return farm.missing().stream()
                .filter(change -> departed.stream().noneMatch(member -> farm.isAt(member, change)))
                .count();
    }

    /**
     * Compares the gauges with the disks, once two successive reads of all gauges agree. Gauges include records of the
     * repair.
     */
    private void compareReported(String when, long undelivered) {
        long[] previous = {-1};
        Until.isTrue("the workers show the same twice", TIMEOUT, () -> {
            long shown =
                    group.shown().values().stream().mapToLong(Shown::onDisk).sum();
            boolean same = shown == previous[0];
            previous[0] = shown;
            return same;
        });
        unshown += Math.max(0, undelivered - previous[0]);
        System.out.printf(
                "  %s: %d notified records are not in Kafka, %d in all are shown%n", when, undelivered, previous[0]);
    }

    /** While the other journals are drained, missing changes must be on the removed disk, as shown. */
    private RemovedDisk checkRemoved(Member departed, long shown) {
        List<NumberedChange> missing = farm.missing().stream()
                .filter(change -> farm.isAt(departed, change))
                .toList();
        unavailable += missing.size();
        unshown += Math.max(0, missing.size() - shown);
        System.out.printf(
                "  unavailable with %s: %d notified records; %d in all were reported%n",
                departed, missing.size(), shown);
        return new RemovedDisk(departed, shown, missing);
    }

    /** The worker must read as many records from the reused disk as were shown, and all must be written to Kafka. */
    private void checkReused(Member worker, RemovedDisk removed) {
        Until.within(ADOPTION_TIMEOUT, () -> worker.gauges().read().recovered() >= removed.shown());
        farm.awaitQuiet();
        long recovered = worker.gauges().read().recovered();
        long delivered = removed.missing().stream()
                .filter(change -> farm.topic.notified(change) > 0)
                .count();
        boolean wrong = exactlyOnce ? recovered != removed.shown() : recovered < removed.shown();
        unshown += wrong ? Math.abs(recovered - removed.shown()) : 0;
        System.out.printf(
                "  back with %s: %d of %d notified records; %d records were on the disk, %d were shown%n",
                worker, delivered, removed.missing().size(), recovered, removed.shown());
    }

    /** The outcome after the last round. */
    Outcome outcome() {
        farm.awaitQuiet();
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
