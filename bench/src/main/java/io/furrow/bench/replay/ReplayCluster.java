package io.furrow.bench.replay;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.Collection;
import java.util.Map;
import java.util.Properties;
import java.util.Set;
import java.util.TreeSet;
import java.util.concurrent.ExecutionException;
import java.util.function.BiConsumer;

import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;

import io.furrow.bench.frame.Engines;
import io.furrow.bench.frame.TopicFiller;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.flink.kafka.KafkaConnectors;
import io.furrow.kafka.CommittedReader;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;
import io.furrow.replay.ReplayJob;
import io.furrow.replay.ReplayOptions;

/**
 * Kafka, MongoDB and the job {@code replay} between them. The broker's default must be to set timestamps itself
 * ({@code log.message.timestamp.type=LogAppendTime}).
 */
final class ReplayCluster implements AutoCloseable {
    private static final Duration POLL = Duration.ofMillis(100);
    private static final Duration STALL = Duration.ofMinutes(2);

    private final Properties kafka;
    private final String mongo;
    private final long checkpointMillis;
    private final ReplayOptions options;
    private final TopicFiller producer;

    ReplayCluster(Engines engines, String mongo, long checkpointMillis, int parallelism)
            throws ExecutionException, InterruptedException {
        this.kafka = engines.client();
        this.mongo = mongo;
        this.checkpointMillis = checkpointMillis;
        options = engines.options(
                "replay",
                new ReplayOptions(),
                "--mongo",
                mongo,
                "--checkpoint-interval",
                checkpointMillis + "ms",
                "--parallelism",
                Integer.toString(parallelism));
        producer = producer();
        Engines.makeTopics(kafka, 1, Map.of("cleanup.policy", "compact"), Topics.REPLAYS, Topics.REPLAYS_STATUS);
    }

    /** The job under measurement. */
    StreamExecutionEnvironment job() {
        return ReplayJob.assemble(options);
    }

    String mongo() {
        return mongo;
    }

    long checkpointMillis() {
        return checkpointMillis;
    }

    /** A producer with the job's settings. */
    TopicFiller producer() {
        Properties settings = KafkaConnectors.producerProperties(options);
        settings.putAll(kafka);
        return new TopicFiller(new KafkaProducer<>(settings, new ByteArraySerializer(), new ByteArraySerializer()));
    }

    void make(Collection<String> topics) throws ExecutionException, InterruptedException {
        Map<String, String> settings = Map.of("retention.ms", "-1", "max.message.bytes", "16777216");
        Engines.makeTopics(kafka, EmbeddedKafka.PARTITIONS, settings, topics.toArray(String[]::new));
    }

    void delete(Collection<String> topics) throws ExecutionException, InterruptedException {
        try (Admin admin = Admin.create(kafka)) {
            admin.deleteTopics(topics).all().get();
        }
    }

    /**
     * Runs replays in the job, and returns when all have ended and no restart can undo that; the job deletes them then.
     *
     * @throws IllegalStateException if one fails, or reports nothing for two minutes
     */
    void play(Collection<DesiredReplay> replays) throws UnreadableException {
        replays.forEach(replay -> put(replay, replay.toBytes()));
        producer.flush();
        Set<String> open = new TreeSet<>();
        replays.forEach(replay -> open.add(replay.replay()));
        long until = System.nanoTime() + STALL.toNanos();
        try (CommittedReader<String> reader = CommittedReader.open(kafka, Topics.REPLAYS_STATUS)) {
            while (!open.isEmpty()) {
                for (ConsumerRecord<String, byte[]> record : reader.poll(POLL)) {
                    until = System.nanoTime() + STALL.toNanos();
                    update(record, open);
                }
                if (System.nanoTime() > until) {
                    throw new IllegalStateException("nothing is heard of " + open);
                }
            }
        }
        replays.forEach(replay -> put(replay, null));
        producer.flush();
    }

    private void put(DesiredReplay replay, byte[] value) {
        byte[] key = replay.replay().getBytes(StandardCharsets.UTF_8);
        producer.send(new ProducerRecord<>(Topics.REPLAYS, key, value));
    }

    private static void update(ConsumerRecord<String, byte[]> record, Set<String> open) throws UnreadableException {
        ReplayStatus status = ReplayStatus.read(record.value());
        if (open.contains(record.key()) && status.state() == ReplayStatus.State.FAILED) {
            throw new IllegalStateException(record.key() + " failed: " + status.reason());
        }
        if (status.state() == ReplayStatus.State.ENDED && status.settled()) {
            open.remove(record.key());
        }
    }

    /**
     * Reads the events of topics from their beginning to their current end.
     *
     * @param out receives each event with its topic
     */
    void read(Collection<String> topics, BiConsumer<String, PlayedRecord> out) {
        try (CommittedReader<byte[]> reader = CommittedReader.openBytes(kafka, topics.toArray(String[]::new))) {
            reader.readToEnd(record -> {
                if (PlayedRecord.isEvent(record)) {
                    out.accept(record.topic(), PlayedRecord.of(record));
                }
            });
        }
    }

    @Override
    public void close() {
        producer.close();
    }
}
