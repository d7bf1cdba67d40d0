package io.furrow.bench.notifications;

import java.net.InetSocketAddress;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.bench.arrival.TopicReader;
import io.furrow.bench.http.BaselineServer;
import io.furrow.bench.http.HttpLoad;
import io.furrow.bench.http.HttpLoadPlan;
import io.furrow.bench.http.HttpLoadResult;

/**
 * Presses an NGSI source with numbered notifications and reads its topic. Senders, source, broker and reader share the
 * processors; each run is followed by the same load on two {@link BaselineServer}s, one with Kafka behind it, and by a {@link BaselineProducer}.
 */
public final class NotificationMeasurement implements AutoCloseable {
    /** In large pieces, because the reader shares the processors. */
    private static final Map<String, String> FETCHING = Map.of(
            "fetch.min.bytes", Integer.toString(256 * 1024), "fetch.max.wait.ms", "100", "max.poll.records", "5000");

    private static final String BARE_TOPIC = "bench.bare";
    private static final int PARTITIONS = 4;
    private static final short REPLICAS = 1;
    private static final long NUMBERS_PER_RUN = 1_000_000_000L;
    private static final Duration QUIET = Duration.ofSeconds(20);
    private static final Duration REPEATS_ON_THEIR_WAY = Duration.ofMillis(500);
    private static final long POLL_INTERVAL_MS = 100;
    private static final int POLLS_PER_SECOND = (int) (1000 / POLL_INTERVAL_MS);

    private final InetSocketAddress source;
    private final String topic;
    private final Properties kafka;
    private final Consumer<String> progress;
    /** One thread for all runs: the processor time of a thread that has ended is not to be had. */
    private final ExecutorService sender =
            Executors.newSingleThreadExecutor(task -> new Thread(task, CpuByPart.SENDER));

    private long firstNumber = NUMBERS_PER_RUN;

    /**
     * Of a source that listens already.
     *
     * @param topic that it writes to
     * @param progress is reported once a second how far it is
     */
    public NotificationMeasurement(
            InetSocketAddress source, String topic, Properties kafka, Consumer<String> progress) {
        this.source = source;
        this.topic = topic;
        this.kafka = kafka;
        this.progress = progress;
    }

    /** Makes the topics, so that no run holds the making of one. */
    public void makeTopics() throws InterruptedException, ExecutionException {
        try (Admin admin = Admin.create(kafka)) {
            admin.createTopics(List.of(
                            new NewTopic(topic, PARTITIONS, REPLICAS), new NewTopic(BARE_TOPIC, PARTITIONS, REPLICAS)))
                    .all()
                    .get();
        }
    }

    /**
     * One run, and its calibration.
     *
     * @param calibration how long the bare server, the bare bridge and the bare producer are each measured
     */
    public NotificationRun run(String name, HttpLoadPlan plan, Duration calibration) throws InterruptedException {
        firstNumber += NUMBERS_PER_RUN;
        ArrivalCheck check = new ArrivalCheck(firstNumber);
        try (TopicReader reader = new TopicReader(kafka, topic, FETCHING, check::add)) {
            reader.start();
            CpuByPart before = CpuByPart.now();
            long start = System.nanoTime();
            HttpLoadResult load = send(name, source, plan, check);
            awaitArrivals(name, load, check);
            Map<String, Long> cpu = before.since();
            TimeUnit.MILLISECONDS.sleep(REPEATS_ON_THEIR_WAY.toMillis());
            double inKafka = load.answered() * 1e9 / Math.max(load.nanos(), check.lastNanos() - start);
            HttpLoadResult bare = bareServer(name, plan.lasting(calibration));
            HttpLoadResult bridge = bareBridge(name, plan.lasting(calibration));
            double producer = bareProducer(name, check.samples(), calibration);
            return new NotificationRun(
                    load, inKafka, check.missing(load.acknowledged()), check.repeats(), cpu, bare, bridge, producer);
        }
    }

    private HttpLoadResult send(String name, InetSocketAddress target, HttpLoadPlan plan, ArrivalCheck check)
            throws InterruptedException {
        HttpLoad load = new HttpLoad(target, plan, firstNumber);
        CompletableFuture<HttpLoadResult> result = CompletableFuture.supplyAsync(load::run, sender);
        for (int looks = 0; !result.isDone(); looks++) {
            if (looks % POLLS_PER_SECOND == 0) {
                progress.accept("%s: %d s of %d, %d acknowledged%s"
                        .formatted(
                                name,
                                looks / POLLS_PER_SECOND,
                                plan.duration().toSeconds(),
                                load.answered(),
                                check == null ? "" : ", " + check.distinct() + " in Kafka"));
            }
            TimeUnit.MILLISECONDS.sleep(POLL_INTERVAL_MS);
        }
        return result.join();
    }

    private void awaitArrivals(String name, HttpLoadResult load, ArrivalCheck check) throws InterruptedException {
        long seen = -1;
        long movedNanos = System.nanoTime();
        while ((check.distinct() < load.answered() || check.missing(load.acknowledged()) > 0)
                && System.nanoTime() - movedNanos < QUIET.toNanos()) {
            if (check.distinct() != seen) {
                seen = check.distinct();
                movedNanos = System.nanoTime();
                progress.accept("%s: %d acknowledged, %d in Kafka".formatted(name, load.answered(), seen));
            }
            TimeUnit.MILLISECONDS.sleep(POLL_INTERVAL_MS);
        }
    }

    private HttpLoadResult bareServer(String name, HttpLoadPlan plan) throws InterruptedException {
        try (BaselineServer server = BaselineServer.start()) {
            return send(name + ", bare server", server.address(), plan, null);
        }
    }

    private HttpLoadResult bareBridge(String name, HttpLoadPlan plan) throws InterruptedException {
        try (BaselineServer server = BaselineServer.bridge(kafka, BARE_TOPIC)) {
            return send(name + ", bare bridge", server.address(), plan, null);
        }
    }

    private double bareProducer(String name, List<ConsumerRecord<byte[], byte[]>> samples, Duration duration) {
        progress.accept(name + ", bare producer");
        return samples.isEmpty() ? Double.NaN : new BaselineProducer(kafka, BARE_TOPIC).perSecond(samples, duration);
    }

    @Override
    public void close() {
        sender.shutdownNow();
    }
}
