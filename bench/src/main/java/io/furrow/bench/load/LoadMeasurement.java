package io.furrow.bench.load;

import java.io.IOException;
import java.time.Duration;
import java.util.EnumMap;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;
import java.util.stream.Stream;

import org.HdrHistogram.Histogram;
import org.apache.kafka.common.errors.TopicExistsException;

import io.furrow.bench.frame.Engines;
import io.furrow.bench.frame.TopicReader;
import io.furrow.model.topic.Topics;
import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.load.LoadFleet;
import io.furrow.simulators.load.LoadPlan;

/**
 * Sends a load as devices do and reads it at the mission's topic. The delays are of at-least-once delivery unless the
 * suite is configured otherwise; sender, suite and reader share the machine and its clock.
 */
public final class LoadMeasurement {
    static final Map<String, String> FETCHING =
            Map.of("isolation.level", "read_committed", "max.partition.fetch.bytes", Integer.toString(8 * 1024 * 1024));
    /**
     * After the last message was sent, this long without an arrival means that the rest is lost: more than the minute that a job of a
     * loaded cluster needs to be submitted again.
     */
    private static final Duration QUIET = Duration.ofSeconds(120);

    /** This long without a record means that the provisioning is complete. */
    private static final Duration SETTLED = Duration.ofSeconds(2);

    private static final int PARTITIONS = 4;
    private static final long POLL_INTERVAL_MS = 100;
    private static final int POLLS_PER_SECOND = (int) (1000 / POLL_INTERVAL_MS);

    private final FleetSettings devices;
    private final Properties kafka;
    private final Consumer<String> progress;

    /** @param progress is called once a second */
    public LoadMeasurement(FleetSettings devices, Properties kafka, Consumer<String> progress) {
        this.devices = devices;
        this.kafka = kafka;
        this.progress = progress;
    }

    /** @throws IOException if the load could not be sent */
    public LoadReport run(LoadPlan plan) throws IOException, InterruptedException, ExecutionException {
        return run(plan, Duration.ZERO);
    }

    /**
     * @param skipped initial time whose delays do not count
     * @throws IOException if the load could not be sent
     */
    public LoadReport run(LoadPlan plan, Duration skipped)
            throws IOException, InterruptedException, ExecutionException {
        String topic = prepare(plan);
        Arrivals arrivals = new Arrivals();
        Arrivals.Interval counted =
                new Arrivals.Interval(System.currentTimeMillis() + skipped.toMillis(), Long.MAX_VALUE);
        try (TopicReader reader = TopicReader.fromEnd(kafka, FETCHING, topic)) {
            reader.follow(arrivals::add);
            long sent = send(plan, arrivals);
            awaitArrivals(sent, arrivals);
            Map<Hop, Histogram> delays = new EnumMap<>(Hop.class);
            Stream.of(Hop.values()).forEach(hop -> delays.put(hop, arrivals.delays(hop, counted)));
            return new LoadReport(
                    plan,
                    sent,
                    arrivals.distinct(),
                    arrivals.repeats(),
                    arrivals.reordered(),
                    arrivals.reorderedAfterSource(),
                    delays,
                    arrivals.seconds());
        }
    }

    /** Creates the mission's topic and its devices, and returns the topic once the notifications about their creation have ended. */
    String prepare(LoadPlan plan) throws IOException, InterruptedException, ExecutionException {
        String topic = Topics.realtime(plan.domain(), plan.mission());
        try { // before the first record, so that no delay includes the creation of a topic
            Engines.makeTopics(kafka, PARTITIONS, Map.of(), topic);
        } catch (ExecutionException e) {
            if (!(e.getCause() instanceof TopicExistsException)) {
                throw e;
            }
        }
        LoadFleet.provision(devices, plan);
        awaitQuiet(topic);
        return topic;
    }

    private long send(LoadPlan plan, Arrivals arrivals) throws IOException, InterruptedException {
        try (LoadFleet fleet = LoadFleet.start(devices, plan)) {
            long polls = 0;
            while (fleet.sent() < plan.messages()
                    && polls * POLL_INTERVAL_MS < plan.duration().toMillis() * 2) {
                TimeUnit.MILLISECONDS.sleep(POLL_INTERVAL_MS);
                if (polls++ % POLLS_PER_SECOND == 0) {
                    progress.accept(
                            "%d of %d sent, %d arrived".formatted(fleet.sent(), plan.messages(), arrivals.distinct()));
                }
            }
            fleet.await();
            return fleet.acknowledged();
        }
    }

    private void awaitArrivals(long expected, Arrivals arrivals) throws InterruptedException {
        long seen = -1;
        long movedNanos = System.nanoTime();
        while (arrivals.distinct() < expected && System.nanoTime() - movedNanos < QUIET.toNanos()) {
            if (arrivals.distinct() != seen) {
                seen = arrivals.distinct();
                movedNanos = System.nanoTime();
            }
            TimeUnit.MILLISECONDS.sleep(POLL_INTERVAL_MS);
        }
        TimeUnit.SECONDS.sleep(1); // duplicates in flight
    }

    /** The context broker reports each new device before the load. */
    private void awaitQuiet(String topic) throws InterruptedException {
        try (TopicReader reader = TopicReader.fromEnd(kafka, Map.of(), topic)) {
            long before = -1;
            long now = -2;
            while (before != now) {
                before = now;
                TimeUnit.MILLISECONDS.sleep(SETTLED.toMillis());
                now = reader.end();
            }
        }
    }
}
