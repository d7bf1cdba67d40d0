package io.furrow.bench.analytics;

import java.lang.management.ManagementFactory;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;

import com.sun.management.OperatingSystemMXBean;

import io.furrow.analytics.collision.CollisionJob;
import io.furrow.analytics.collision.CollisionOptions;
import io.furrow.bench.analytics.load.CrowdedFleet;
import io.furrow.bench.analytics.load.Fleet;
import io.furrow.bench.analytics.load.FleetTopic;
import io.furrow.bench.ingest.IngestMeasurement.Cluster;
import io.furrow.bench.ingest.IngestMeasurement.Running;
import io.furrow.flink.job.JobCommandLine;

/** Runs the job {@code collision} on NGSI entities from a topic, with its results on another. */
public final class TopicMeasurement {
    private static final Duration TIMEOUT = Duration.ofMinutes(10);
    private static final long POLL_INTERVAL_MS = 20;
    /** The default of jobs. */
    static final int CHECKPOINTS_SECONDS = 10;

    private static final int POLLS_PER_SECOND = 5;
    /** Event time at the end of the input that the watermark never passes, and a little more. */
    private static final long BEHIND_MS = 3000;

    private static final OperatingSystemMXBean SYSTEM =
            (OperatingSystemMXBean) ManagementFactory.getOperatingSystemMXBean();

    private final Cluster cluster;
    private final Consumer<String> progress;
    private int runs;

    public TopicMeasurement(Cluster cluster, Consumer<String> progress) {
        this.cluster = cluster;
        this.progress = progress;
    }

    /** How far a job is. */
    private record Reading(long nanos, long cpuNanos, long event) {}

    /** Updates per second of a topic that was filled before. */
    public void updates(int devices, int parallelism, int partitions, long records, Figures figures) throws Exception {
        try (FleetTopic topic = FleetTopic.create("data.fleet-" + runs++, partitions, cluster.kafka())) {
            topic.fill(devices, records);
            progress.accept("%,d records of %,d devices written".formatted(records, devices));
            double bare = BaselineReader.perSecond(topic, devices);
            long span = 1000 * records / devices;
            Running job = start(topic, parallelism, List.of());
            try (FoundReader found = new FoundReader(cluster.kafka(), topic.results())) {
                Reading from = await(found, Fleet.START + span / 4);
                Reading to = await(found, Fleet.START + span - BEHIND_MS);
                double updates = (to.event - from.event) / 1000.0 * devices;
                figures.add(
                        "devices",
                        devices,
                        "cores",
                        parallelism,
                        "partitions",
                        partitions,
                        "updates/s",
                        updates / (to.nanos - from.nanos) * 1e9,
                        "cpu us",
                        (to.cpuNanos - from.cpuNanos) / 1e3 / updates,
                        "bare loop",
                        bare,
                        "found",
                        found.count());
            } finally {
                job.cancel();
            }
        }
    }

    /**
     * What is to be held, and for how long.
     *
     * @param devices each reports once a second
     * @param side meters, of the square in which they are
     * @param ongoingEvery option of the job
     */
    public record Held(
            int devices, double side, int parallelism, String ongoingEvery, Duration warmUp, Duration measured) {}

    /** A fleet that reports as time goes by, and how far the job's consumer is behind it, second by second. */
    public SustainedRate held(Held plan) throws Exception {
        try (FleetTopic topic = FleetTopic.create("data.fleet-" + runs++, cluster.kafka())) {
            Thread fleet = new Thread(() -> topic.report(plan.devices, plan.side), "bench-fleet");
            Running job = start(topic, plan.parallelism, List.of("--ongoing-every", plan.ongoingEvery));
            fleet.start();
            try (GroupLag lag = new GroupLag(cluster.kafka(), topic.name(), jobName())) {
                TimeUnit.MILLISECONDS.sleep(plan.warmUp.toMillis());
                long begin = System.nanoTime();
                long sent = topic.sent();
                long found = lag.written(topic.results());
                List<Long> lags = new ArrayList<>();
                for (int second = 0; second < plan.measured.toSeconds(); second++) {
                    lags.add(leastLag(lag, begin + Duration.ofSeconds(second).toNanos()));
                    progress.accept("%d s: lag %,d".formatted(second + 1, lags.get(second)));
                }
                double seconds = (System.nanoTime() - begin) / 1e9;
                return new SustainedRate(
                        plan.devices,
                        plan.side,
                        (topic.sent() - sent) / seconds,
                        (lag.written(topic.results()) - found) / seconds,
                        lags);
            } finally {
                topic.stop();
                fleet.join();
                job.cancel();
            }
        }
    }

    /** In the second that begins at this time. */
    private static long leastLag(GroupLag lag, long begin) throws Exception {
        long least = Long.MAX_VALUE;
        for (int look = 1; look <= POLLS_PER_SECOND; look++) {
            long next = begin + Duration.ofSeconds(look).toNanos() / POLLS_PER_SECOND;
            TimeUnit.NANOSECONDS.sleep(next - System.nanoTime());
            least = Math.min(least, lag.records());
        }
        return least;
    }

    /** A job that starts when all of a backlog is there. */
    public void backlog(Backlog plan, Figures figures) throws Exception {
        try (FleetTopic topic = FleetTopic.create("data.fleet-" + runs++, 2, cluster.kafka())) {
            topic.fillUnevenly(plan.devices(), plan.records(), plan.padding());
            progress.accept("%,d records of %,d devices written".formatted(plan.records(), plan.devices()));
            Backlog.Reading reading = new Backlog.Reading(plan);
            long begin = System.nanoTime();
            Running job = start(topic, 2, List.of("--max-drift", plan.maxDrift()));
            try (FoundReader found = new FoundReader(cluster.kafka(), topic.results());
                    GroupLag lag = new GroupLag(cluster.kafka(), topic.name(), jobName())) {
                while (found.newest() < plan.end() - BEHIND_MS) {
                    TimeUnit.SECONDS.sleep(Backlog.POLL_INTERVAL_SECONDS);
                    progress.accept(reading.look(lag));
                }
                reading.addTo(figures, (System.nanoTime() - begin) / 1e9, found.count());
            } finally {
                job.cancel();
            }
        }
    }

    /**
     * Devices on one spot beside a fleet, and how far the job's results are behind, second by second.
     *
     * @param plan the devices on the spot
     * @param others devices of the fleet, each with a report a second too
     */
    public SustainedCrowd crowd(SustainedCrowd.Plan plan, int others, int parallelism) throws Exception {
        try (FleetTopic topic = FleetTopic.create("data.fleet-" + runs++, cluster.kafka())) {
            CrowdedFleet fleet = new CrowdedFleet(plan.devices(), others);
            Thread reports = new Thread(() -> topic.report(fleet::tick), "bench-fleet");
            Running job = start(topic, parallelism, List.of("--overflow-output", topic.overflows()));
            reports.start();
            try (CrowdReader found = new CrowdReader(cluster.kafka(), topic)) {
                List<Long> lags = new ArrayList<>();
                TimeUnit.MILLISECONDS.sleep(plan.warmUp().toMillis());
                for (long second = 1; second <= plan.measured().toSeconds(); second++) {
                    TimeUnit.SECONDS.sleep(1);
                    lags.add(found.lag());
                    progress.accept("%d s: lag %,d ms, %,d records".formatted(second, found.lag(), found.count()));
                }
                topic.stop();
                TimeUnit.MILLISECONDS.sleep(2 * BEHIND_MS);
                return found.held(plan, others, lags);
            } finally {
                topic.stop();
                reports.join();
                job.cancel();
            }
        }
    }

    private static Reading await(FoundReader found, long event) throws InterruptedException {
        long end = System.nanoTime() + TIMEOUT.toNanos();
        while (found.newest() < event) {
            if (System.nanoTime() > end) {
                throw new IllegalStateException("%d results after %d s, event time at %d, awaited %d"
                        .formatted(found.count(), TIMEOUT.toSeconds(), found.newest(), event));
            }
            TimeUnit.MILLISECONDS.sleep(POLL_INTERVAL_MS);
        }
        return new Reading(System.nanoTime(), SYSTEM.getProcessCpuTime(), found.newest());
    }

    private String jobName() {
        return "collision-" + runs;
    }

    /** Under a name of its own each reads from the beginning. */
    Running start(FleetTopic topic, int parallelism, List<String> more) throws Exception {
        List<String> args = new ArrayList<>(more);
        args.addAll(List.of("--bootstrap-servers", cluster.kafka().getProperty("bootstrap.servers")));
        args.addAll(List.of("--input", topic.name(), "--output", topic.results()));
        args.addAll(List.of("--parallelism", Integer.toString(parallelism)));
        args.addAll(List.of("--checkpoint-interval", CHECKPOINTS_SECONDS + "s"));
        args.addAll(List.of(
                "--checkpoint-dir",
                cluster.checkpoints().resolve(jobName()).toUri().toString()));
        CollisionOptions options = new CollisionOptions();
        JobCommandLine.of(options).setCommandName(jobName()).parseArgs(args.toArray(String[]::new));
        return cluster.flink().start(jobName(), CollisionJob.assemble(options));
    }
}
