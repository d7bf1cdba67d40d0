package io.furrow.soak.ingest;

import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.atomic.AtomicReference;
import java.util.concurrent.locks.LockSupport;
import java.util.function.IntPredicate;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.ConsumerRecords;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;

import io.furrow.model.device.DeviceVersion;
import io.furrow.model.topic.Topics;

/**
 * Creates the input topics, writes the {@link FarmLoad} to them at a rate, and waits until the job has written its
 * output.
 */
public final class LoadWriter {
    private static final Duration TIMEOUT = Duration.ofMinutes(2);

    private final Map<String, Object> kafka;
    private volatile int written;

    LoadWriter(String bootstrapServers) {
        this.kafka = Map.of("bootstrap.servers", bootstrapServers);
    }

    /**
     * Arguments: bootstrap servers, records per second (0 for no limit), and either the number of records or a file
     * that ends the load when it exists. The last line of the output is the number of records.
     */
    public static void main(String... args) throws Exception {
        LoadWriter writer = new LoadWriter(args[0]);
        writer.createTopics();
        System.out.println("writing");
        boolean counted = args[2].matches("\\d+");
        int max = counted ? Integer.parseInt(args[2]) : Integer.MAX_VALUE;
        Path endFile = Path.of(args[2]);
        int count =
                writer.write(Integer.parseInt(args[1]), number -> number < max && (counted || !Files.exists(endFile)));
        System.out.println("wrote " + count + " records");
        long startedAt = System.nanoTime();
        writer.awaitOutput(TIMEOUT);
        System.out.printf(
                "all read %d ms after the last%n",
                Duration.ofNanos(System.nanoTime() - startedAt).toMillis());
        System.out.println(count);
    }

    /**
     * Creates topics that retain records of any time, because retention depends on the record timestamp. {@code
     * data.latest} is created in advance without compaction, so that all records written to it can be compared.
     */
    void createTopics() throws ExecutionException, InterruptedException {
        try (Admin admin = Admin.create(kafka);
                var producer = producer()) {
            admin.createTopics(List.of(
                            topic(Topics.RAW, FarmLoad.PARTITIONS),
                            topic(Topics.DEVICES, 1),
                            topic(Topics.LATEST, FarmLoad.PARTITIONS)))
                    .all()
                    .get();
            for (DeviceVersion version : FarmLoad.devices().toList()) {
                byte[] key = FarmLoad.utf8(version.key());
                producer.send(new ProducerRecord<>(Topics.DEVICES, 0, version.from(), key, version.toBytes()))
                        .get();
            }
        }
    }

    private static NewTopic topic(String name, int partitions) {
        return new NewTopic(name, Optional.of(partitions), Optional.empty()).configs(Map.of("retention.ms", "-1"));
    }

    /** @param hasNext whether to write the record with this number; called once per number */
    int write(int perSecond, IntPredicate hasNext) {
        AtomicReference<Exception> firstFailure = new AtomicReference<>();
        try (var producer = producer()) {
            long startedAt = System.nanoTime();
            for (; hasNext.test(written); written++) {
                if (perSecond > 0) {
                    LockSupport.parkNanos(startedAt + written * 1_000_000_000L / perSecond - System.nanoTime());
                }
                producer.send(FarmLoad.record(written), (done, failure) -> firstFailure.compareAndSet(null, failure));
            }
            for (int partition = 0; partition < FarmLoad.PARTITIONS; partition++) {
                producer.send(FarmLoad.closing(partition, written));
            }
        }
        if (firstFailure.get() != null) {
            throw new IllegalStateException("a record was not written", firstFailure.get());
        }
        return written;
    }

    /** The number of records sent so far. */
    int written() {
        return written;
    }

    /**
     * Returns once the last event of each partition is committed on the topic of its domain.
     *
     * @param timeout maximum time without output
     */
    void awaitOutput(Duration timeout) {
        long until = System.nanoTime() + timeout.toNanos();
        Map<String, Object> settings = new HashMap<>(kafka);
        settings.put("auto.offset.reset", "earliest");
        settings.put("isolation.level", "read_committed");
        settings.put("allow.auto.create.topics", "false");
        Set<String> closed = new HashSet<>();
        try (var consumer = new KafkaConsumer<>(settings, new ByteArrayDeserializer(), new ByteArrayDeserializer())) {
            while (closed.size() < FarmLoad.PARTITIONS) {
                if (System.nanoTime() > until) {
                    throw new IllegalStateException("no record was emitted for " + timeout + "; of "
                            + FarmLoad.PARTITIONS + " partitions only these are complete: " + closed);
                }
                if (assign(consumer)) {
                    ConsumerRecords<byte[], byte[]> records = consumer.poll(Duration.ofMillis(200));
                    until = records.isEmpty() ? until : System.nanoTime() + timeout.toNanos();
                    records.forEach(record -> {
                        if (FarmLoad.isClosing(record.key())) {
                            closed.add(new String(record.key(), java.nio.charset.StandardCharsets.UTF_8));
                        }
                    });
                }
            }
        }
    }

    /** False until the topic exists. */
    private static boolean assign(KafkaConsumer<byte[], byte[]> consumer) {
        if (consumer.assignment().isEmpty()) {
            consumer.assign(consumer.partitionsFor(Topics.realtime(FarmLoad.DOMAIN)).stream()
                    .map(info -> new TopicPartition(info.topic(), info.partition()))
                    .toList());
            LockSupport.parkNanos(Duration.ofMillis(100).toNanos());
        }
        return !consumer.assignment().isEmpty();
    }

    private KafkaProducer<byte[], byte[]> producer() {
        Map<String, Object> settings = new HashMap<>(kafka);
        settings.put("acks", "all");
        settings.put("linger.ms", "5");
        // With topics that were just created, a broker may reject the first of two requests and accept the second
        // (KAFKA-15591).
        settings.put("max.in.flight.requests.per.connection", "1");
        return new KafkaProducer<>(settings, new ByteArraySerializer(), new ByteArraySerializer());
    }
}
