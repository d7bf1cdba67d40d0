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

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.ProducerRecord;

import io.furrow.bench.frame.Engines;
import io.furrow.bench.frame.TopicReader;
import io.furrow.bench.http.BaselineServer;
import io.furrow.bench.http.HttpLoad;

/**
 * Loads an NGSI source with numbered notifications and reads its topic. Senders, source, broker and reader share the processors; each run
 * is followed by the same load on two {@link BaselineServer}s, one with Kafka behind it, and by a {@link BaselineProducer}.
 */
final class NotificationMeasurement implements AutoCloseable {
    /** Large fetches, because the reader shares the processors. */
    private static final Map<String, String> FETCHING = Map.of(
            "isolation.level", "read_committed",
            "fetch.min.bytes", Integer.toString(256 * 1024),
            "fetch.max.wait.ms", "100",
            "max.poll.records", "5000");

    private static final String BARE_TOPIC = "bench.bare";
    private static final int PARTITIONS = 4;
    private static final long NUMBERS_PER_RUN = 1_000_000_000L;
    private static final Duration REPEATS_ON_THEIR_WAY = Duration.ofMillis(500);
    private static final long POLL_INTERVAL_MS = 100;
    private static final int POLLS_PER_SECOND = (int) (1000 / POLL_INTERVAL_MS);

    private final InetSocketAddress source;
    private final String topic;
    private final Properties kafka;
    private final Consumer<String> progress;
    /** One thread for all runs: the processor time of an ended thread is not available. */
    private final ExecutorService sender =
            Executors.newSingleThreadExecutor(task -> new Thread(task, CpuByPart.SENDER));

    private long firstNumber = NUMBERS_PER_RUN;

    /**
     * Measures a source that already listens.
     *
     * @param topic that it writes to
     * @param progress is called once a second
     */
    NotificationMeasurement(InetSocketAddress source, String topic, Properties kafka, Consumer<String> progress) {
        this.source = source;
        this.topic = topic;
        this.kafka = kafka;
        this.progress = progress;
    }

    /** Creates the topics, so that no run includes their creation. */
    void makeTopics() throws InterruptedException, ExecutionException {
        Engines.makeTopics(kafka, PARTITIONS, Map.of(), topic, BARE_TOPIC);
    }

    /**
     * Runs a load and its calibration.
     *
     * @param calibration duration of each measurement of the bare server, the bare bridge and the bare producer
     */
    NotificationReport.Run run(String name, HttpLoad.Plan plan, Duration calibration) throws InterruptedException {
        firstNumber += NUMBERS_PER_RUN;
        ArrivalCheck check = new ArrivalCheck(firstNumber);
        try (TopicReader reader = TopicReader.fromEnd(kafka, FETCHING, topic)) {
            reader.follow(check::add);
            CpuByPart before = CpuByPart.now();
            long start = System.nanoTime();
            HttpLoad.Result load = send(name, source, plan, check);
            check.await(
                    load.acknowledged(),
                    arrived -> progress.accept(
                            "%s: %d acknowledged, %d in Kafka".formatted(name, load.answered(), arrived)));
            Map<String, Long> cpu = before.since();
            TimeUnit.MILLISECONDS.sleep(REPEATS_ON_THEIR_WAY.toMillis());
            double inKafka = load.answered() * 1e9 / Math.max(load.nanos(), check.lastNanos() - start);
            HttpLoad.Result bare = bare(name + ", bare server", BaselineServer.start(), plan.lasting(calibration));
            HttpLoad.Result bridge =
                    bare(name + ", bare bridge", BaselineServer.bridge(kafka, BARE_TOPIC), plan.lasting(calibration));
            double producer = bareProducer(name, check.samples(), calibration);
            return new NotificationReport.Run(
                    load, inKafka, check.missing(load.acknowledged()), check.repeats(), cpu, bare, bridge, producer);
        }
    }

    private HttpLoad.Result send(String name, InetSocketAddress target, HttpLoad.Plan plan, ArrivalCheck check)
            throws InterruptedException {
        HttpLoad load = new HttpLoad(target, plan, firstNumber);
        CompletableFuture<HttpLoad.Result> result = CompletableFuture.supplyAsync(load::run, sender);
        for (int polls = 0; !result.isDone(); polls++) {
            if (polls % POLLS_PER_SECOND == 0) {
                progress.accept("%s: %d s of %d, %d acknowledged%s"
                        .formatted(
                                name,
                                polls / POLLS_PER_SECOND,
                                plan.duration().toSeconds(),
                                load.answered(),
                                check == null ? "" : ", " + check.distinct() + " in Kafka"));
            }
            TimeUnit.MILLISECONDS.sleep(POLL_INTERVAL_MS);
        }
        return result.join();
    }

    private HttpLoad.Result bare(String name, BaselineServer started, HttpLoad.Plan plan) throws InterruptedException {
        try (BaselineServer server = started) {
            return send(name, server.address(), plan, null);
        }
    }

    private double bareProducer(String name, List<ConsumerRecord<byte[], byte[]>> samples, Duration duration) {
        progress.accept(name + ", bare producer");
        if (samples.isEmpty()) {
            return Double.NaN;
        }
        return BaselineProducer.perSecond(
                kafka,
                number -> {
                    ConsumerRecord<byte[], byte[]> sample = samples.get(number % samples.size());
                    return new ProducerRecord<>(
                            BARE_TOPIC, null, sample.timestamp(), sample.key(), sample.value(), sample.headers());
                },
                duration);
    }

    @Override
    public void close() {
        sender.shutdownNow();
    }
}
