package io.furrow.control;

import java.nio.file.Path;
import java.time.Clock;
import java.time.Duration;
import java.time.Instant;
import java.time.InstantSource;
import java.time.ZoneOffset;
import java.util.ArrayList;
import java.util.Date;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.atomic.AtomicReference;
import java.util.stream.IntStream;
import java.util.stream.Stream;

import com.mongodb.client.MongoClients;
import com.mongodb.client.MongoDatabase;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.acl.AccessControlEntry;
import org.apache.kafka.common.acl.AclBinding;
import org.apache.kafka.common.acl.AclBindingFilter;
import org.apache.kafka.common.acl.AclOperation;
import org.apache.kafka.common.acl.AclPermissionType;
import org.apache.kafka.common.resource.PatternType;
import org.apache.kafka.common.resource.Resource;
import org.apache.kafka.common.resource.ResourcePattern;
import org.apache.kafka.common.resource.ResourceType;
import org.bson.Document;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.control.replay.RecordingWatch;
import io.furrow.control.replay.ReplaySettings;
import io.furrow.control.replay.TopicCleanup;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.EmbeddedMongo;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.RecordedMission;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.control.Requests;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Runs two instances each of recording watch and topic cleanup. */
@Tag("full")
class ReplayUpkeepIT {
    /** Denies the deletion of single topics only. */
    private static final ResourcePattern WHOLE_CLUSTER =
            new ResourcePattern(ResourceType.CLUSTER, Resource.CLUSTER_NAME, PatternType.LITERAL);

    private final List<AutoCloseable> open = new ArrayList<>();
    private EmbeddedKafka kafka;
    private KafkaProducer<String, byte[]> producer;
    private Admin admin;
    private Properties client;

    @BeforeEach
    void start(@TempDir Path directory) throws Exception {
        kafka = register(EmbeddedKafka.start(
                directory.resolve("kafka"),
                0,
                Map.of(
                        "authorizer.class.name", "org.apache.kafka.metadata.authorizer.StandardAuthorizer",
                        "allow.everyone.if.no.acl.found", "true")));
        client = kafka.client();
        client.setProperty("state.dir", directory.resolve("state").toString());
        ServiceTopics.prepare(ControlSettings.of(client));
        producer = register(KafkaClients.producer(client));
        admin = register(Admin.create(client));
    }

    @AfterEach
    void stop() throws Exception {
        for (int i = open.size() - 1; i >= 0; i--) {
            open.get(i).close();
        }
    }

    private <T extends AutoCloseable> T register(T part) {
        open.add(part);
        return part;
    }

    private void send(String topic, String key, byte[] value) throws Exception {
        producer.send(new ProducerRecord<>(topic, key, value)).get();
    }

    @Test
    void listsRecordedMissionsAndRejectsReplaysOfOthers() throws Exception {
        EmbeddedMongo mongo = register(EmbeddedMongo.inMemory());
        MongoDatabase missions = register(MongoClients.create(mongo.uri())).getDatabase("persistence");
        missions.getCollection("mission_weeding")
                .insertMany(List.of(new Document("_time", new Date(1000)), new Document("_time", new Date(3000))));
        var settings = ReplaySettings.DEFAULT.withMongo(mongo.uri()).withPollInterval(Duration.ofMillis(100));
        TopicContent recordings = new TopicContent(client, Topics.RECORDINGS);
        for (int i = 0; i < 2; i++) {
            register(RecordingWatch.start(client, settings, Clock.systemUTC()));
        }
        await().until(() -> recordings.newest().containsKey("weeding"));
        assertThat(RecordedMission.read(recordings.newest().get("weeding")))
                .isEqualTo(new RecordedMission("weeding", 1000, 3000, 2));

        ControlPlane plane =
                register(ControlPlane.start(ControlSettings.of(client).with(settings)));
        await().until(plane::isHealthy);
        assertThat(answer("weeding").status()).isEqualTo("created");
        assertThat(answer("harrowing").error()).contains("unknown-mission");
        missions.getCollection("mission_harrowing").insertOne(new Document("_time", new Date(5000)));
        await().until(() -> answer("harrowing").status().equals("created"));
        missions.getCollection("mission_weeding").drop();
        await().until(() -> answer("weeding").error().isPresent());
    }

    private int requested;

    private CommandResult answer(String mission) throws Exception {
        String id = "r-" + requested++;
        send(
                Topics.REPLAY_MANAGER,
                null,
                Requests.write(id, new ReplayCommand.Start(List.of(mission), null, 1, null, ReplayPlan.PLAIN)));
        TopicContent answers = new TopicContent(client, Topics.REPLAY_MANAGER);
        await().until(() -> answers.newest().containsKey(id));
        return CommandResult.read(answers.newest().get(id));
    }

    @Test
    void deletesOnlyTopicsOfFinishedReplays() throws Exception {
        String own = "data.show.replay.0000000a";
        List<String> removed = List.of(own, own + ".collision", own + ".collision.late", own + ".clocks");
        List<String> retained = List.of("""
                        data.b.replay.0000000b data.b.replay.0000000b.collision data.show.replay.0000000ab
                        data.a.realtime""".split("\\s+"));
        kafka.createTopics(Stream.concat(removed.stream(), retained.stream())
                .map(name -> new NewTopic(name, 1, (short) 1))
                .toList());
        send(Topics.REPLAYS, "a.0000000a", desired("a", own));
        send(Topics.REPLAYS_STATUS, "a.0000000a", over());
        send(Topics.REPLAYS, "b.0000000b", desired("b", "data.b.replay.0000000b"));
        send(Topics.REPLAYS_STATUS, "b.0000000b", over()); // of the previous start
        send(Topics.REPLAYS, "a.0000000a", null);

        TopicCleanup early = register(
                TopicCleanup.start(client, ReplaySettings.DEFAULT.withGrace(Duration.ofHours(1)), Clock.systemUTC()));
        await().until(() -> early.status().lastSuccess() != null);
        assertThat(names()).containsAll(removed);
        for (int i = 0; i < 2; i++) {
            register(TopicCleanup.start(client, ReplaySettings.DEFAULT.withGrace(Duration.ZERO), Clock.systemUTC()));
        }

        await().until(() -> names().stream().noneMatch(removed::contains));
        TopicContent statuses = new TopicContent(client, Topics.REPLAYS_STATUS);
        await().until(() -> !statuses.newest().containsKey("a.0000000a"));
        assertThat(names()).containsAll(retained);
        assertThat(statuses.newest()).containsOnlyKeys("b.0000000b");
    }

    @Test
    void deletesTheTopicOfADeletedMissionAfterAQuietDay() throws Exception {
        kafka.createTopics(Stream.of("weeding", "mowing", "sowing", "sowing-2", "sowing-2.dead", "played", "own")
                .map(mission -> new NewTopic("data.farm.realtime." + mission, 2, (short) 1))
                .toList());
        long now = System.currentTimeMillis();
        for (String mission : List.of("weeding", "mowing", "sowing", "sowing-2", "played")) {
            send(Topics.MISSIONS, mission, "{\"domain\":\"farm\"}".getBytes(UTF_8));
        }
        for (String topic : List.of("weeding", "mowing", "sowing", "sowing-2", "sowing-2.dead", "played")) {
            boolean isFresh = topic.equals("sowing") || topic.equals("sowing-2.dead");
            long reported = isFresh ? now + Duration.ofMinutes(30).toMillis() : now - 1_000;
            producer.send(new ProducerRecord<>("data.farm.realtime." + topic, 0, reported, "d", new byte[1]))
                    .get();
        }
        for (String mission : List.of("weeding", "sowing", "sowing-2", "played")) {
            producer.send(new ProducerRecord<>(Topics.MISSIONS, 0, Long.valueOf(now - 1), mission, (byte[]) null))
                    .get();
        }
        ReplayPlan plan = new ReplayPlan(
                new ReplayPlan.Source("data.farm.realtime.played", null),
                null,
                null,
                false,
                List.of(),
                null,
                ReplayPlan.Stamps.ORIGINAL,
                null,
                List.of());
        send(
                Topics.REPLAYS,
                "played.0000000a",
                DesiredReplay.started("played", "data.played.replay.0000000a", plan, 1, 0, 1)
                        .toBytes());

        AtomicReference<Instant> clock =
                new AtomicReference<>(Instant.ofEpochMilli(now).plus(Duration.ofDays(1)));
        InstantSource time = clock::get;
        TopicCleanup cleanup = register(TopicCleanup.start(
                client, ReplaySettings.DEFAULT.withGrace(Duration.ofSeconds(1)), time.withZone(ZoneOffset.UTC)));
        await().until(() -> cleanup.status().lastSuccess() != null);
        assertThat(names()).as("in use again").contains("data.farm.realtime.weeding");
        clock.set(clock.get().plus(Duration.ofMinutes(15)));
        await().until(() -> !names().contains("data.farm.realtime.weeding"));
        Instant later = clock.updateAndGet(instant -> instant.plusMillis(1));
        await().until(() -> later.equals(cleanup.status().lastSuccess()));

        assertThat(names()).contains("""
                                data.farm.realtime.mowing data.farm.realtime.sowing data.farm.realtime.sowing-2
                                data.farm.realtime.played data.farm.realtime.own""".split("\\s+"));
    }

    @Test
    void deletesOtherTopicsIfOneDeletionIsDenied() throws Exception {
        List<String> protectedTopics = IntStream.range(0, 8)
                .mapToObj(number -> "data.farm.realtime.guarded-" + number)
                .toList();
        String free = "data.farm.realtime.weeding";
        kafka.createTopics(Stream.concat(protectedTopics.stream(), Stream.of(free, Topics.dead(free)))
                .map(name -> new NewTopic(name, 1, (short) 1))
                .toList());
        admin.createAcls(Stream.concat(protectedTopics.stream().map(ReplayUpkeepIT::topic), Stream.of(WHOLE_CLUSTER))
                        .flatMap(resource -> Stream.of(
                                acl(resource, AclOperation.ALL, AclPermissionType.ALLOW),
                                acl(resource, AclOperation.DELETE, AclPermissionType.DENY)))
                        .toList())
                .all()
                .get();
        for (String topic :
                Stream.concat(protectedTopics.stream(), Stream.of(free)).toList()) {
            String mission = topic.substring(topic.lastIndexOf('.') + 1);
            send(Topics.MISSIONS, mission, "{\"domain\":\"farm\"}".getBytes(UTF_8));
            send(Topics.MISSIONS, mission, null);
        }

        AtomicReference<Instant> clock = new AtomicReference<>(Instant.now().plus(Duration.ofDays(2)));
        InstantSource time = clock::get;
        TopicCleanup cleanup = register(TopicCleanup.start(
                client, ReplaySettings.DEFAULT.withGrace(Duration.ofSeconds(1)), time.withZone(ZoneOffset.UTC)));
        await().until(() -> cleanup.status().lastSuccess() != null);
        clock.set(clock.get().plus(Duration.ofMinutes(15)));

        await().until(() -> !names().contains(free) && !names().contains(Topics.dead(free)));
        assertThat(names()).containsAll(protectedTopics);
        await().until(() -> cleanup.status().detail().contains("topic data.farm.realtime.guarded-"));
        admin.deleteAcls(List.of(AclBindingFilter.ANY)).all().get();
        clock.set(clock.get().plus(Duration.ofMinutes(10)));
        await().until(() -> names().stream().noneMatch(protectedTopics::contains));
    }

    private static ResourcePattern topic(String name) {
        return new ResourcePattern(ResourceType.TOPIC, name, PatternType.LITERAL);
    }

    private static AclBinding acl(ResourcePattern resource, AclOperation operation, AclPermissionType permission) {
        return new AclBinding(resource, new AccessControlEntry("User:ANONYMOUS", "*", operation, permission));
    }

    private Set<String> names() throws Exception {
        return admin.listTopics().names().get();
    }

    private static byte[] desired(String mission, String topic) {
        return DesiredReplay.started(mission, topic, ReplayPlan.PLAIN, 1, 0, 1).toBytes();
    }

    private static byte[] over() {
        return new ReplayStatus(1, ReplayStatus.State.ENDED, null, true, null).toBytes();
    }
}
