package io.furrow.soak.replay;

import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Random;
import java.util.Set;
import java.util.TreeMap;
import java.util.concurrent.locks.LockSupport;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;

import io.furrow.model.control.ReplayStatus;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Stores missions, starts replays of them, sends random commands until a file exists, and stops the replays. */
public final class ReplaySteering {
    private static final int MIN_MILLIS = 200;
    private static final int MAX_MILLIS = 1_700;
    private static final Duration TIMEOUT = Duration.ofMinutes(3);

    private final Map<String, Object> kafka;
    private final List<SteeredReplay> replays;
    private final Random random;

    private ReplaySteering(String bootstrapServers, int count, long seed) {
        this.kafka = Map.of("bootstrap.servers", bootstrapServers);
        this.replays = IntStream.range(0, count).mapToObj(SteeredReplay::new).toList();
        this.random = new Random(seed);
    }

    /**
     * Arguments: bootstrap servers, URI of MongoDB, number of replays, seed, and a file that ends the run when it
     * exists. Returns once all replays are stopped and settled.
     */
    public static void main(String... args) throws Exception {
        ReplaySteering steering = new ReplaySteering(args[0], Integer.parseInt(args[2]), Long.parseLong(args[3]));
        try (MongoClient client = MongoClients.create(args[1])) {
            for (SteeredReplay replay : steering.replays) {
                replay.store(client);
            }
        }
        steering.createTopics();
        steering.run(Path.of(args[4]));
    }

    private void createTopics() throws Exception {
        try (Admin admin = Admin.create(kafka)) {
            admin.createTopics(List.of(compacted(Topics.REPLAYS), compacted(Topics.REPLAYS_STATUS)))
                    .all()
                    .get();
        }
    }

    private static NewTopic compacted(String name) {
        return new NewTopic(name, Optional.of(1), Optional.empty()).configs(Map.of("cleanup.policy", "compact"));
    }

    private void run(Path endFile) throws Exception {
        Map<String, Integer> commands = new TreeMap<>();
        try (var producer = new KafkaProducer<>(kafka, new ByteArraySerializer(), new ByteArraySerializer())) {
            for (SteeredReplay replay : replays) {
                write(replay, producer);
            }
            System.out.println("steering");
            while (!Files.exists(endFile)) {
                LockSupport.parkNanos(Duration.ofMillis(random.nextInt(MIN_MILLIS, MAX_MILLIS))
                        .toNanos());
                SteeredReplay replay = replays.get(random.nextInt(replays.size()));
                commands.merge(replay.steer(random), 1, Integer::sum);
                write(replay, producer);
            }
            for (SteeredReplay replay : replays) {
                replay.stop();
                write(replay, producer);
            }
        }
        awaitStopped();
        System.out.println("steered: " + commands);
    }

    private static void write(SteeredReplay replay, KafkaProducer<byte[], byte[]> producer) throws Exception {
        byte[] key = replay.desired().replay().getBytes(UTF_8);
        producer.send(new ProducerRecord<>(Topics.REPLAYS, key, replay.desired().toBytes()))
                .get();
    }

    private void awaitStopped() throws UnreadableException {
        Set<String> pending =
                replays.stream().map(replay -> replay.desired().replay()).collect(Collectors.toSet());
        long until = System.nanoTime() + TIMEOUT.toNanos();
        TopicPartition statuses = new TopicPartition(Topics.REPLAYS_STATUS, 0);
        try (var consumer = new KafkaConsumer<>(kafka, new ByteArrayDeserializer(), new ByteArrayDeserializer())) {
            consumer.assign(List.of(statuses));
            consumer.seekToBeginning(List.of(statuses));
            while (!pending.isEmpty()) {
                for (ConsumerRecord<byte[], byte[]> record : consumer.poll(Duration.ofMillis(200))) {
                    ReplayStatus status = ReplayStatus.read(record.value());
                    if (status.state() == ReplayStatus.State.FAILED) {
                        throw new IllegalStateException("a replay failed: " + status.reason());
                    }
                    if (status.state() == ReplayStatus.State.STOPPED && status.settled()) {
                        pending.remove(new String(record.key(), UTF_8));
                    }
                }
                if (System.nanoTime() > until) {
                    throw new IllegalStateException("not stopped after " + TIMEOUT + ": " + pending);
                }
            }
        }
    }
}
