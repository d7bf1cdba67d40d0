package io.furrow.bench.replay;

import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collection;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.Set;
import java.util.TreeSet;
import java.util.concurrent.ExecutionException;
import java.util.function.BiConsumer;

import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;

import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.kafka.KafkaConnectors;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;
import io.furrow.replay.ReplayJob;
import io.furrow.replay.ReplayOptions;

/**
 * Kafka, MongoDB and the job {@code replay} between them. The broker must stamp the records of topics that it has no other setting for
 * by itself ({@code log.message.timestamp.type=LogAppendTime}).
 */
public final class ReplayCluster implements AutoCloseable {
    private static final Duration POLL = Duration.ofMillis(100);
    private static final Duration STALL = Duration.ofMinutes(2);

    private final Properties kafka;
    private final String mongo;
    private final ReplayOptions options = new ReplayOptions();
    private final KafkaProducer<byte[], byte[]> producer;

    /** @param kafka settings of any client */
    public ReplayCluster(Properties kafka, String mongo, Path checkpoints, ReplayBenchPlan plan)
            throws ExecutionException, InterruptedException {
        this.kafka = kafka;
        this.mongo = mongo;
        List<String> args = new ArrayList<>(List.of("--bootstrap-servers", kafka.getProperty("bootstrap.servers")));
        args.addAll(List.of(
                "--mongo", mongo, "--checkpoint-dir", checkpoints.toUri().toString()));
        args.addAll(List.of("--checkpoint-interval", plan.checkpointInterval().toMillis() + "ms"));
        args.addAll(List.of("--parallelism", Integer.toString(plan.parallelism())));
        JobCommandLine.of(options).parseArgs(args.toArray(String[]::new));
        producer = producer();
        try (Admin admin = Admin.create(kafka)) {
            admin.createTopics(List.of(compacted(Topics.REPLAYS), compacted(Topics.REPLAYS_STATUS)))
                    .all()
                    .get();
        }
    }

    private static NewTopic compacted(String topic) {
        return new NewTopic(topic, Optional.of(1), Optional.empty()).configs(Map.of("cleanup.policy", "compact"));
    }

    /** The job, to be run as long as it is measured. */
    public StreamExecutionEnvironment job() {
        return ReplayJob.assemble(options);
    }

    String mongo() {
        return mongo;
    }

    /** With the settings of the job's. */
    KafkaProducer<byte[], byte[]> producer() {
        Properties settings = KafkaConnectors.producerProperties(options);
        settings.putAll(kafka);
        return new KafkaProducer<>(settings, new ByteArraySerializer(), new ByteArraySerializer());
    }

    void make(Collection<String> topics) throws ExecutionException, InterruptedException {
        try (Admin admin = Admin.create(kafka)) {
            admin.createTopics(topics.stream()
                            .map(topic -> new NewTopic(topic, Optional.empty(), Optional.empty())
                                    .configs(Map.of("retention.ms", "-1", "max.message.bytes", "16777216")))
                            .toList())
                    .all()
                    .get();
        }
    }

    void delete(Collection<String> topics) throws ExecutionException, InterruptedException {
        try (Admin admin = Admin.create(kafka)) {
            admin.deleteTopics(topics).all().get();
        }
    }

    void want(Collection<DesiredReplay> replays) {
        replays.forEach(replay -> producer.send(new ProducerRecord<>(
                Topics.REPLAYS, replay.replay().getBytes(StandardCharsets.UTF_8), replay.toBytes())));
        producer.flush();
    }

    private void forget(Collection<DesiredReplay> replays) {
        replays.forEach(replay -> producer.send(
                new ProducerRecord<>(Topics.REPLAYS, replay.replay().getBytes(StandardCharsets.UTF_8), null)));
        producer.flush();
    }

    /**
     * Returns when all have ended and no restart takes that back; the job forgets them then.
     *
     * @throws IllegalStateException if one fails, or nothing is heard for two minutes
     */
    void awaitEnd(Collection<DesiredReplay> replays) throws UnreadableException {
        Set<String> open = new TreeSet<>();
        replays.forEach(replay -> open.add(replay.replay()));
        long until = System.nanoTime() + STALL.toNanos();
        try (KafkaConsumer<byte[], byte[]> consumer = consumer()) {
            List<TopicPartition> partitions = partitions(consumer, Topics.REPLAYS_STATUS);
            consumer.assign(partitions);
            consumer.seekToBeginning(partitions);
            while (!open.isEmpty()) {
                for (ConsumerRecord<byte[], byte[]> record : consumer.poll(POLL)) {
                    until = System.nanoTime() + STALL.toNanos();
                    note(record, open);
                }
                if (System.nanoTime() > until) {
                    throw new IllegalStateException("nothing is heard of " + open);
                }
            }
        }
        forget(replays);
    }

    private static void note(ConsumerRecord<byte[], byte[]> record, Set<String> open) throws UnreadableException {
        String name = new String(record.key(), StandardCharsets.UTF_8);
        ReplayStatus status = ReplayStatus.read(record.value());
        if (open.contains(name) && status.state() == ReplayStatus.State.FAILED) {
            throw new IllegalStateException(name + " failed: " + status.reason());
        }
        if (status.state() == ReplayStatus.State.ENDED && status.settled()) {
            open.remove(name);
        }
    }

    /**
     * Reads the events of topics from their beginning to their end of now.
     *
     * @param out is called with the topic of each
     */
    void read(Collection<String> topics, BiConsumer<String, PlayedRecord> out) {
        try (KafkaConsumer<byte[], byte[]> consumer = consumer()) {
            List<TopicPartition> partitions = topics.stream()
                    .flatMap(topic -> partitions(consumer, topic).stream())
                    .toList();
            consumer.assign(partitions);
            consumer.seekToBeginning(partitions);
            Map<TopicPartition, Long> ends = consumer.endOffsets(partitions);
            while (ends.entrySet().stream().anyMatch(end -> consumer.position(end.getKey()) < end.getValue())) {
                for (ConsumerRecord<byte[], byte[]> record : consumer.poll(POLL)) {
                    if (PlayedRecord.isEvent(record)) {
                        out.accept(record.topic(), PlayedRecord.of(record));
                    }
                }
            }
        }
    }

    private KafkaConsumer<byte[], byte[]> consumer() {
        Map<String, Object> settings = new HashMap<>();
        kafka.forEach((name, value) -> settings.put((String) name, value));
        settings.put("isolation.level", "read_committed");
        return new KafkaConsumer<>(settings, new ByteArrayDeserializer(), new ByteArrayDeserializer());
    }

    private static List<TopicPartition> partitions(KafkaConsumer<?, ?> consumer, String topic) {
        return consumer.partitionsFor(topic).stream()
                .map(info -> new TopicPartition(topic, info.partition()))
                .toList();
    }

    @Override
    public void close() {
        producer.close(Duration.ofSeconds(1));
    }
}
