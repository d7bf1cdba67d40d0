package io.furrow.bench.sink;

import java.net.InetSocketAddress;
import java.net.URI;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.ArrayList;
import java.util.BitSet;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.function.BiConsumer;
import java.util.function.Consumer;
import java.util.function.Supplier;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.consumer.OffsetAndMetadata;
import org.apache.kafka.clients.producer.ProducerRecord;

import io.furrow.bench.frame.Engines;
import io.furrow.bench.frame.TopicFiller;
import io.furrow.bench.http.BaselineServer;
import io.furrow.bench.http.HttpLoad;
import io.furrow.bench.http.NotificationRequest;
import io.furrow.model.event.HeaderNames;

/** Fills a topic, lets the sink write it to a context broker, and measures the time. */
final class SinkMeasurement {
    private static final int PARTITIONS = 4;
    private static final int ENTITIES_PER_REQUEST = 100;
    private static final Duration TIMEOUT = Duration.ofMinutes(3);
    private static final long POLL_INTERVAL_MS = 100;
    private static final int POLLS_PER_SECOND = (int) (1000 / POLL_INTERVAL_MS);

    private final Properties kafka;
    private final BiConsumer<String, URI> sink;
    private final Consumer<String> progress;

    /**
     * @param sink starts the sink of this name with a context broker, and returns when it runs
     * @param progress is called once a second
     */
    SinkMeasurement(Properties kafka, BiConsumer<String, URI> sink, Consumer<String> progress) {
        this.kafka = kafka;
        this.sink = sink;
        this.progress = progress;
    }

    /** Several {@linkplain #run runs} whose names end with their number. */
    List<SinkReport.Run> runs(int runs, String name, SinkReport.Plan plan, URI contextBroker)
            throws InterruptedException, ExecutionException {
        List<SinkReport.Run> measured = new ArrayList<>();
        for (int number = 1; number <= runs; number++) {
            measured.add(run(name + "-" + number, plan, contextBroker));
        }
        return measured;
    }

    /**
     * One run.
     *
     * @param name of the topic and of the sink
     * @param contextBroker one that does not count, so that the time includes the sink's start; null for a receiver that only
     *     answers
     */
    SinkReport.Run run(String name, SinkReport.Plan plan, URI contextBroker)
            throws InterruptedException, ExecutionException {
        fill(name, plan);
        if (contextBroker != null) {
            long start = System.nanoTime();
            sink.accept(name, contextBroker);
            awaitCommitted(name, plan.records(), () -> "into " + contextBroker);
            return new SinkReport.Run(System.nanoTime() - start, 0, 0, 0, Double.NaN);
        }
        try (StubBroker broker = StubBroker.start()) {
            sink.accept(name, broker.uri());
            awaitCommitted(name, plan.records(), () -> broker.entities() + " entities written");
            long missing = missing(plan, broker.numbers());
            return new SinkReport.Run(
                    broker.nanos(), broker.entities(), broker.requests(), missing, bareEntitiesPerSecond(plan));
        }
    }

    private void fill(String topic, SinkReport.Plan plan) throws InterruptedException, ExecutionException {
        progress.accept(topic + ": filling the topic");
        Engines.makeTopics(kafka, PARTITIONS, Map.of(), topic);
        NotificationRequest entities = NotificationRequest.to(
                InetSocketAddress.createUnresolved("127.0.0.1", 0), plan.payloadBytes(), plan.entities());
        long firstMillis = System.currentTimeMillis() - plan.records();
        try (TopicFiller filler = new TopicFiller(kafka, Map.of())) {
            for (int number = 0; number < plan.records(); number++) {
                long millis = firstMillis + number;
                byte[] key = Integer.toString(number % plan.entities()).getBytes(StandardCharsets.US_ASCII);
                ProducerRecord<byte[], byte[]> record =
                        new ProducerRecord<>(topic, null, millis, key, entities.entityWith(number, millis));
                record.headers().add(HeaderNames.SERVICE, "farm".getBytes(StandardCharsets.US_ASCII));
                record.headers().add(HeaderNames.SERVICE_PATH, "/".getBytes(StandardCharsets.US_ASCII));
                filler.send(record);
            }
        }
    }

    private void awaitCommitted(String sink, long records, Supplier<String> state)
            throws InterruptedException, ExecutionException {
        long end = System.nanoTime() + TIMEOUT.toNanos();
        try (Admin admin = Admin.create(kafka)) {
            for (int polls = 0; committed(admin, sink) < records; polls++) {
                if (System.nanoTime() > end) {
                    throw new IllegalStateException("the sink has not committed %d records within %d s"
                            .formatted(records, TIMEOUT.toSeconds()));
                }
                if (polls % POLLS_PER_SECOND == 0) {
                    progress.accept("%s: %d s, %s".formatted(sink, polls / POLLS_PER_SECOND, state.get()));
                }
                TimeUnit.MILLISECONDS.sleep(POLL_INTERVAL_MS);
            }
        }
    }

    private static long committed(Admin admin, String sink) throws InterruptedException, ExecutionException {
        return admin.listConsumerGroupOffsets("connect-" + sink).partitionsToOffsetAndMetadata().get().values().stream()
                .mapToLong(OffsetAndMetadata::offset)
                .sum();
    }

    /** The newest record of each entity must have arrived; older ones may have been merged into it. */
    static long missing(SinkReport.Plan plan, BitSet arrived) {
        BitSet newest = new BitSet();
        newest.set(plan.records() - plan.entities(), plan.records());
        newest.andNot(arrived);
        return newest.cardinality();
    }

    private static double bareEntitiesPerSecond(SinkReport.Plan plan) {
        try (BaselineServer server = BaselineServer.start()) {
            HttpLoad.Plan load = new HttpLoad.Plan(
                    4, false, 0, ENTITIES_PER_REQUEST * plan.payloadBytes(), 1, Duration.ofSeconds(3));
            return new HttpLoad(server.address(), load, 0).run().perSecond() * ENTITIES_PER_REQUEST;
        }
    }
}
