package io.furrow.bench.load;

import java.io.IOException;
import java.lang.management.ManagementFactory;
import java.lang.management.MemoryMXBean;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.Callable;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;

import org.HdrHistogram.Histogram;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.ConsumerRecords;

import io.furrow.bench.arrival.TopicReader;
import io.furrow.model.event.HeaderNames;
import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.load.LoadFleet;
import io.furrow.simulators.load.LoadPlan;

/**
 * Sends a rate, half of it, twice as much, and half of it again until nothing waits any more, and follows what arrives. Sender, suite and
 * reader share the machine, its clock and the heap.
 */
public final class OverloadMeasurement {
    private static final int PAYLOAD = 1_000;
    /** Of a device at the rate; other rates have other periods. */
    private static final int PERIOD_MS = 200;

    private static final String DOMAIN = "bench";
    private static final String MISSION = "overload";
    private static final Duration DRAIN_STEP = Duration.ofSeconds(2);
    private static final Duration MAX_DRAIN = Duration.ofMinutes(5);
    /** After nothing waits any more, until delays count again. */
    private static final Duration RECOVERY = Duration.ofSeconds(5);

    private final FleetSettings devices;
    private final Properties kafka;
    private final Callable<Long> pending;
    private final Plan plan;
    private final Consumer<String> progress;
    private final MemoryMXBean memory = ManagementFactory.getMemoryMXBean();
    private final List<Passage> passages = new ArrayList<>();
    private final Set<String> ids = new HashSet<>();
    private long repeats;
    private long sent;

    /**
     * What is sent.
     *
     * @param rate messages per second, a multiple of 5
     * @param stage of each rate
     * @param bursts whether twice the rate comes as four times the rate in every other second
     */
    public record Plan(int rate, Duration stage, boolean bursts) {
        /** At the rate times the factor. */
        private LoadPlan load(double factor, Duration duration) {
            int devices = Math.max(1, rate * PERIOD_MS / 1000);
            Duration period = Duration.ofMillis(Math.round(PERIOD_MS / factor));
            return new LoadPlan(devices, period, PAYLOAD, duration, DOMAIN, MISSION);
        }
    }

    private record Passage(long device, long reader) {}

    /** @param pending records on the source's disk, as its {@code /health} says */
    public OverloadMeasurement(
            FleetSettings devices, Properties kafka, Callable<Long> pending, Plan plan, Consumer<String> progress) {
        this.devices = devices;
        this.kafka = kafka;
        this.pending = pending;
        this.plan = plan;
        this.progress = progress;
    }

    /** @throws IOException if a load could not be sent, or what waited had not arrived after {@link #MAX_DRAIN} */
    public OverloadReport run() throws Exception {
        String topic = new LoadMeasurement(devices, kafka, progress).prepare(plan.load(1, plan.stage()));
        try (TopicReader reader = new TopicReader(kafka, topic, LoadMeasurement.FETCHING, this::add)) {
            reader.start();
            for (double share : new double[] {0.25, 0.5, 1}) {
                send(share, plan.stage());
            }
            awaitAll();

            progress.accept("the rate");
            Interval knee = send(1, plan.stage());
            long kneeHeap = heapAfterCollection();
            awaitAll();
            progress.accept("half of it");
            Interval before = send(0.5, plan.stage());
            awaitAll();
            progress.accept("twice as much");
            Interval over = plan.bursts() ? bursts() : send(2, plan.stage());
            long onDisk = pending.call();
            long overHeap = heapAfterCollection();
            progress.accept("half of it again");
            long usual = mostWaiting(before);
            long from = System.currentTimeMillis();
            while (sent - arrived() > usual) {
                if (System.currentTimeMillis() - from > MAX_DRAIN.toMillis()) {
                    throw new IOException(
                            "%d messages have not arrived after %s".formatted(sent - arrived(), MAX_DRAIN));
                }
                send(0.5, DRAIN_STEP);
                progress.accept("%d wait".formatted(sent - arrived()));
            }
            send(0.5, RECOVERY);
            Interval after = send(0.5, plan.stage());
            awaitAll();
            return new OverloadReport(
                    plan,
                    stage(knee),
                    stage(before),
                    stage(over),
                    stage(after),
                    drain(over.to(), usual),
                    kneeHeap,
                    overHeap,
                    onDisk,
                    sent,
                    arrived(),
                    repeats);
        }
    }

    private record Interval(long from, long to) {}

    private Interval send(double factor, Duration duration) throws IOException, InterruptedException {
        LoadPlan load = plan.load(factor, duration);
        try (LoadFleet fleet = LoadFleet.start(devices, load)) {
            long from = System.currentTimeMillis();
            fleet.await();
            sent += fleet.acknowledged();
            return new Interval(from, System.currentTimeMillis());
        }
    }

    private Interval bursts() throws IOException, InterruptedException {
        long from = System.currentTimeMillis();
        for (long second = 0; second < plan.stage().toSeconds(); second += 2) {
            send(4, Duration.ofSeconds(1));
            long next = from + (second + 2) * 1000;
            TimeUnit.MILLISECONDS.sleep(Math.max(0, next - System.currentTimeMillis()));
        }
        return new Interval(from, System.currentTimeMillis());
    }

    private void awaitAll() throws InterruptedException {
        long until = System.currentTimeMillis() + MAX_DRAIN.toMillis();
        while (arrived() < sent && System.currentTimeMillis() < until) {
            TimeUnit.MILLISECONDS.sleep(100);
        }
    }

    private long heapAfterCollection() {
        memory.gc();
        return memory.getHeapMemoryUsage().getUsed();
    }

    private synchronized void add(ConsumerRecords<byte[], byte[]> records) {
        long now = System.currentTimeMillis();
        for (ConsumerRecord<byte[], byte[]> record : records) {
            if (ids.add(header(record, HeaderNames.CE_ID))) {
                passages.add(new Passage(Long.parseLong(header(record, HeaderNames.TS_DEVICE)), now));
            } else {
                repeats++;
            }
        }
    }

    private static String header(ConsumerRecord<byte[], byte[]> record, String name) {
        return new String(record.headers().lastHeader(name).value(), StandardCharsets.UTF_8);
    }

    private synchronized long arrived() {
        return passages.size();
    }

    private synchronized OverloadReport.Stage stage(Interval interval) {
        Histogram delays = new Histogram(3_600_000, 3);
        passages.stream()
                .filter(passage -> passage.device() >= interval.from() && passage.device() < interval.to())
                .forEach(passage -> delays.recordValue(Math.max(0, passage.reader() - passage.device())));
        long arrived = passages.stream()
                .filter(passage -> passage.reader() >= interval.from() && passage.reader() < interval.to())
                .count();
        double seconds = (interval.to() - interval.from()) / 1000.0;
        return new OverloadReport.Stage(
                delays.getTotalCount() / seconds, arrived / seconds, waiting(interval.to()), delays);
    }

    /** Messages on their way at an instant. */
    private synchronized long waiting(long at) {
        return passages.stream()
                .filter(passage -> passage.device() <= at && passage.reader() > at)
                .count();
    }

    private long mostWaiting(Interval interval) {
        long most = 0;
        for (long at = interval.from(); at <= interval.to(); at += 100) {
            most = Math.max(most, waiting(at));
        }
        return most;
    }

    /** From an instant until no more messages wait than is usual. */
    private OverloadReport.Drain drain(long from, long usual) {
        long first = waiting(from);
        long at = from;
        while (waiting(at) > usual) {
            at += 100;
        }
        return new OverloadReport.Drain(first, waiting(at), Duration.ofMillis(at - from));
    }
}
