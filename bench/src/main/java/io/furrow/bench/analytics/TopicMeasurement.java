package io.furrow.bench.analytics;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;

import io.furrow.analytics.collision.CollisionJob;
import io.furrow.analytics.collision.CollisionOptions;
import io.furrow.bench.analytics.load.CrowdedFleet;
import io.furrow.bench.analytics.load.Fleet;
import io.furrow.bench.analytics.load.FleetTopic;
import io.furrow.bench.frame.CpuReading;
import io.furrow.bench.frame.Engines;
import io.furrow.bench.frame.Figures;

/** Runs the job {@code collision} between topics, on NGSI entities. */
final class TopicMeasurement {
    private static final Duration TIMEOUT = Duration.ofMinutes(10);
    private static final long POLL_INTERVAL_MS = 20;
    /** The default of jobs. */
    static final int CHECKPOINTS_SECONDS = 10;

    private static final int POLLS_PER_SECOND = 5;
    /** Event time at the end of the input that the watermark never passes, plus a margin. */
    private static final long BEHIND_MS = 3000;

    private final Engines engines;
    private final Consumer<String> progress;
    private int runs;

    TopicMeasurement(Engines engines, Consumer<String> progress) {
        this.engines = engines;
        this.progress = progress;
    }

    /** A sample of a job's progress. */
    private record Reading(CpuReading cpu, long event) {}

    /** Updates per second from a prefilled topic. */
    void updates(int devices, int parallelism, int partitions, long records, Figures figures) throws Exception {
        try (FleetTopic topic = topic(partitions)) {
            topic.fill(devices, records);
            progress.accept("%,d records of %,d devices written".formatted(records, devices));
            double bare = BaselineReader.perSecond(topic, devices);
            long span = 1000 * records / devices;
            Engines.Job job = start(topic, parallelism);
            try (ResultReader found = new ResultReader(topic.kafka(), topic.results())) {
                Reading from = await(found, Fleet.START + span / 4);
                Reading to = await(found, Fleet.START + span - BEHIND_MS);
                double updates = (to.event - from.event) / 1000.0 * devices;
                figures.add(
                        "devices", devices,
                        "cores", parallelism,
                        "partitions", partitions,
                        "updates/s", updates / to.cpu.seconds(from.cpu),
                        "cpu us", to.cpu.cpuSeconds(from.cpu) * 1e6 / updates,
                        "bare loop", bare,
                        "found", found.count());
            } finally {
                job.cancel();
            }
        }
    }

    /** Runs a fleet in real time and samples the lag of the job's consumer each second. */
    SustainedRate sustained(SustainedRate.Plan plan, Duration warmUp, long measuredSeconds) throws Exception {
        try (FleetTopic topic = topic(FleetTopic.PARTITIONS)) {
            Thread fleet = new Thread(() -> topic.report(plan.devices(), plan.side()), "bench-fleet");
            Engines.Job job = start(topic, plan.parallelism(), "--ongoing-every", plan.ongoingEvery());
            fleet.start();
            try (GroupLag lag = new GroupLag(topic.kafka(), topic.name(), jobName())) {
                TimeUnit.MILLISECONDS.sleep(warmUp.toMillis());
                long begin = System.nanoTime();
                long sent = topic.sent();
                long found = lag.written(topic.results());
                List<Long> lags = new ArrayList<>();
                for (int second = 0; second < measuredSeconds; second++) {
                    lags.add(leastLag(lag, begin + Duration.ofSeconds(second).toNanos()));
                    progress.accept("%d s: lag %,d".formatted(second + 1, lags.get(second)));
                }
                double seconds = (System.nanoTime() - begin) / 1e9;
                double foundPerSecond = (lag.written(topic.results()) - found) / seconds;
                return new SustainedRate(plan, (topic.sent() - sent) / seconds, foundPerSecond, lags);
            } finally {
                topic.stop();
                fleet.join();
                job.cancel();
            }
        }
    }

    /** The least lag in the second that begins at this time. */
    private static long leastLag(GroupLag lag, long begin) throws Exception {
        long least = Long.MAX_VALUE;
        for (int poll = 1; poll <= POLLS_PER_SECOND; poll++) {
            long next = begin + Duration.ofSeconds(poll).toNanos() / POLLS_PER_SECOND;
            TimeUnit.NANOSECONDS.sleep(next - System.nanoTime());
            least = Math.min(least, lag.records());
        }
        return least;
    }

    /** Runs a job that starts with a complete backlog. */
    void backlog(Backlog plan, Figures figures) throws Exception {
        try (FleetTopic topic = topic(2)) {
            topic.fillUnevenly(plan.devices(), plan.records(), plan.padding());
            progress.accept("%,d records of %,d devices written".formatted(plan.records(), plan.devices()));
            Backlog.Reading reading = new Backlog.Reading(plan);
            long begin = System.nanoTime();
            Engines.Job job = start(topic, 2, "--max-drift", plan.maxDrift());
            try (ResultReader found = new ResultReader(topic.kafka(), topic.results());
                    GroupLag lag = new GroupLag(topic.kafka(), topic.name(), jobName())) {
                while (found.newest() < plan.end() - BEHIND_MS) {
                    TimeUnit.SECONDS.sleep(Backlog.POLL_INTERVAL_SECONDS);
                    progress.accept(reading.sample(lag));
                }
                reading.addTo(figures, (System.nanoTime() - begin) / 1e9, found.count());
            } finally {
                job.cancel();
            }
        }
    }

    /** Runs devices on one spot beside a fleet, each with a report a second, and samples the delay of the job's results each second. */
    CrowdResults crowd(int crowd, int others, int parallelism, Duration warmUp, long seconds, Figures figures)
            throws Exception {
        try (FleetTopic topic = topic(FleetTopic.PARTITIONS)) {
            CrowdedFleet fleet = new CrowdedFleet(crowd, others);
            Thread reports = new Thread(() -> topic.report(fleet::tick), "bench-fleet");
            Engines.Job job = start(topic, parallelism, "--overflow-output", topic.overflows());
            reports.start();
            try (CrowdResults results = new CrowdResults(topic)) {
                TimeUnit.MILLISECONDS.sleep(warmUp.toMillis());
                for (long second = 1; second <= seconds; second++) {
                    TimeUnit.SECONDS.sleep(1);
                    progress.accept(
                            "%d s: lag %,d ms, %,d records".formatted(second, results.recordLag(), results.count()));
                }
                topic.stop();
                TimeUnit.MILLISECONDS.sleep(2 * BEHIND_MS);
                results.compare(others);
                results.addTo(figures, crowd, others, warmUp);
                return results;
            } finally {
                topic.stop();
                reports.join();
                job.cancel();
            }
        }
    }

    private static Reading await(ResultReader found, long event) throws InterruptedException {
        long end = System.nanoTime() + TIMEOUT.toNanos();
        while (found.newest() < event) {
            if (System.nanoTime() > end) {
                throw new IllegalStateException("%d results after %d s, event time at %d, awaited %d"
                        .formatted(found.count(), TIMEOUT.toSeconds(), found.newest(), event));
            }
            TimeUnit.MILLISECONDS.sleep(POLL_INTERVAL_MS);
        }
        return new Reading(CpuReading.now(), found.newest());
    }

    private FleetTopic topic(int partitions) throws Exception {
        return FleetTopic.create("data.fleet-" + runs++, partitions, engines.client());
    }

    private String jobName() {
        return "collision-" + runs;
    }

    /** Each job has its own name and so reads from the beginning. */
    private Engines.Job start(FleetTopic topic, int parallelism, String... more) throws Exception {
        List<String> words = new ArrayList<>(List.of("--input", topic.name(), "--output", topic.results()));
        words.addAll(List.of("--parallelism", Integer.toString(parallelism)));
        words.addAll(List.of("--checkpoint-interval", CHECKPOINTS_SECONDS + "s"));
        words.addAll(List.of(more));
        return engines.submit(
                jobName(),
                CollisionJob.assemble(
                        engines.options(jobName(), new CollisionOptions(), words.toArray(String[]::new))));
    }
}
