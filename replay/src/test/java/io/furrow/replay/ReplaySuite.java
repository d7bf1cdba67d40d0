package io.furrow.replay;

import java.net.URI;
import java.nio.file.Path;
import java.time.Clock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.TimeUnit;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.mongodb.client.MongoClient;
import org.apache.flink.api.common.JobID;
import org.apache.flink.core.execution.RecoveryClaimMode;
import org.apache.flink.core.execution.SavepointFormatType;
import org.apache.flink.runtime.jobgraph.SavepointRestoreSettings;
import org.apache.flink.streaming.api.graph.StreamGraph;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.bson.RawBsonDocument;

import io.furrow.embedded.EmbeddedFlink;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.EmbeddedMongo;
import io.furrow.embedded.FreePort;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.kafka.CommittedReader;
import io.furrow.mission.StoredEvent;
import io.furrow.mission.mongo.EventDocumentCodec;
import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.Retention;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.control.ReplayStatus.State;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Runs the job {@code replay} on Kafka, Flink and an embedded MongoDB for the duration of a test. */
final class ReplaySuite implements AutoCloseable {
    static final long TIME = 1_600_000_000_000L;

    private static final Duration TIMEOUT = Duration.ofSeconds(60);
    private static final int SLOTS = 4;

    private final EmbeddedKafka kafka;
    private final EmbeddedFlink flink;
    private final Path documents;
    private final int mongoPort = FreePort.orFree(0);
    private final KafkaProducer<byte[], byte[]> producer;
    private EmbeddedMongo mongo;

    private ReplaySuite(Path directory) throws Exception {
        kafka = EmbeddedKafka.start(directory.resolve("kafka"));
        flink = EmbeddedFlink.start(SLOTS, 0);
        documents = directory.resolve("mongo");
        producer = new KafkaProducer<>(kafka.client(), new ByteArraySerializer(), new ByteArraySerializer());
        startMongo();
        NewTopic topic = new NewTopic(Topics.REPLAYS, Optional.of(1), Optional.empty())
                .configs(Map.of("cleanup.policy", "compact"));
        kafka.createTopics(List.of(topic));
    }

    static ReplaySuite start(Path directory) throws Exception {
        return new ReplaySuite(directory);
    }

    void startMongo() {
        mongo = EmbeddedMongo.start(documents, mongoPort);
    }

    void stopMongo() {
        mongo.close();
        mongo = null;
    }

    EmbeddedFlink flink() {
        return flink;
    }

    /**
     * Stores events of four devices in turn.
     *
     * @param apart ms between events
     */
    void store(String mission, int count, long apart) throws Exception {
        try (MongoClient client = new MongoAccess(mongo.uri(), MongoAccess.Waits.of(TIMEOUT)).open()) {
            var missions = new MissionCollections(client, Retention.of(null, Map.of()), Clock.systemUTC());
            List<RawBsonDocument> events = new ArrayList<>();
            for (int i = 0; i < count; i++) {
                String id = "urn:d" + i % 4;
                ObjectNode entity =
                        JsonNodeFactory.instance.objectNode().put("id", id).put("type", "T");
                entity.putObject("n").put("type", "Integer").put("value", i).putObject("metadata");
                events.add(new RawBsonDocument(EventDocumentCodec.write(new StoredEvent(
                        "e%05d".formatted(i), TIME + i * apart, id, Map.of("ce_source", "/test"), entity))));
            }
            missions.prepared(MissionCollections.nameOf(mission)).insertMany(events);
        }
    }

    static DesiredReplay desired(String mission, double speed, State state, long sequence) {
        return DesiredReplay.started(mission, Topics.replay(mission, "0a1b2c3d"), ReplayPlan.PLAIN, speed, 0, sequence)
                .desired(state, sequence);
    }

    void publish(DesiredReplay desired) throws Exception {
        producer.send(new ProducerRecord<>(Topics.REPLAYS, desired.replay().getBytes(UTF_8), desired.toBytes()))
                .get();
    }

    /**
     * Starts the job.
     *
     * @param savepoint null to start without state
     */
    JobID run(String savepoint, String... args) {
        ReplayOptions options = new ReplayOptions();
        List<String> all = new ArrayList<>(List.of(args));
        all.addAll(List.of("--bootstrap-servers", kafka.bootstrapServers()));
        all.addAll(List.of("--mongo", "mongodb://127.0.0.1:" + mongoPort, "--mongo-timeout", "500ms"));
        all.addAll(List.of("--checkpoint-interval", "300ms", "--restart-delay", "100ms", "--topic-partitions", "3"));
        JobCommandLine.of(options).parseArgs(all.toArray(String[]::new));
        StreamGraph graph = ReplayJob.assemble(options).getStreamGraph();
        if (savepoint != null) {
            graph.setSavepointRestoreSettings(
                    SavepointRestoreSettings.forPath(savepoint, false, RecoveryClaimMode.NO_CLAIM));
        }
        return flink.submit(graph);
    }

    void delete(String topic) throws Exception {
        try (Admin admin = Admin.create(kafka.client())) {
            admin.deleteTopics(List.of(topic)).all().get();
        }
    }

    String stop(JobID job, Path directory) throws Exception {
        return flink.cluster()
                .stopWithSavepoint(job, directory.toUri().toString(), false, SavepointFormatType.CANONICAL)
                .get(TIMEOUT.toSeconds(), TimeUnit.SECONDS);
    }

    static Path path(String savepoint) {
        return Path.of(URI.create(savepoint));
    }

    /** Returns the committed records of an existing topic, in the order of each partition. */
    List<ConsumerRecord<byte[], byte[]>> records(String topic) {
        List<ConsumerRecord<byte[], byte[]>> records = new ArrayList<>();
        try (CommittedReader<byte[]> reader = CommittedReader.openBytes(kafka.client(), topic)) {
            reader.readToEnd(records::add);
        }
        return records;
    }

    /** Returns the newest status of a replay; null if there is none. */
    ReplayStatus status(String mission) throws Exception {
        ReplayStatus newest = null;
        for (ConsumerRecord<byte[], byte[]> record : records(Topics.REPLAYS_STATUS)) {
            if (text(record.key()).equals(mission + ".0a1b2c3d")) {
                newest = ReplayStatus.read(record.value());
            }
        }
        return newest;
    }

    static String header(ConsumerRecord<byte[], byte[]> record, String name) {
        return text(record.headers().lastHeader(name).value());
    }

    static String text(byte[] bytes) {
        return new String(bytes, UTF_8);
    }

    @Override
    public void close() {
        producer.close(Duration.ofSeconds(1));
        flink.close();
        kafka.close();
        if (mongo != null) {
            mongo.close();
        }
    }
}
