package io.furrow.connect.source;

import java.nio.file.Path;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.TimeUnit;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.AlterConfigOp;
import org.apache.kafka.clients.admin.ConfigEntry;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.common.config.ConfigResource;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.connect.ConnectRig;
import io.furrow.connect.TopicReader;
import io.furrow.embedded.FreePort;
import io.furrow.model.event.DeadLetter;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** A real topic that takes 1 MiB, and records of 2 MiB, each with a small one behind it. */
@Tag("full")
class LargeRecordsIT {
    private static final String MIB = Integer.toString(1024 * 1024);
    private static final String LARGE = "x".repeat(2 * 1024 * 1024);

    @TempDir
    static Path directory;

    private static ConnectRig rig;
    private static Admin admin;

    @BeforeAll
    static void start() {
        rig = ConnectRig.start(directory);
        admin = Admin.create(Map.of("bootstrap.servers", rig.bootstrapServers()));
    }

    @AfterAll
    static void stop() {
        admin.close();
        rig.close();
    }

    @Test
    void becomeDeadLettersWhereTheTopicTakesLessThanTheProducer() throws Exception {
        make(rig, "narrow", MIB);
        make(rig, "narrow.dead", MIB);
        SourceOnConnect source = create(rig, "narrow", "ngsi-source-subscribing", Map.of("context.broker.url", ""));

        post(source, "large", LARGE);
        post(source, "small", "x");

        assertDeadAndAlive(rig, "narrow");
        assertThat(source.ledger("oversized")).isEqualTo(1);
        rig.awaitRunning("narrow");
    }

    @Test
    void becomeDeadLettersExactlyOnceToo() throws Exception {
        Map<String, String> exactlyOnce = Map.of("exactly.once.source.support", "enabled");
        try (ConnectRig other = ConnectRig.start(directory.resolve("once"), exactlyOnce)) {
            make(other, "once", MIB);
            make(other, "once.dead", MIB);
            SourceOnConnect source = create(other, "once", "ngsi-source-exactly-once", Map.of("tasks.max", "1"));

            post(source, "large", LARGE);
            post(source, "small", "x");

            assertDeadAndAlive(other, "once");
        }
    }

    @Test
    void becomeDeadLettersWhereTheLimitWasLoweredWhileTheyWaited() throws Exception {
        make(rig, "lowered", "16777216");
        make(rig, "lowered.dead", "16777216");
        SourceOnConnect source = create(rig, "lowered", "ngsi-source-subscribing", Map.of("context.broker.url", ""));
        rig.pause("lowered");
        post(source, "large", LARGE);
        post(source, "small", "x");

        rig.stop("lowered");
        lower("lowered");
        rig.resume("lowered");

        assertDeadAndAlive(rig, "lowered");
    }

    @Test
    void becomeDeadLettersWhereNothingIsKnownOfTheTopic() throws Exception {
        make(rig, "default", MIB);
        SourceOnConnect source =
                create(rig, "default", "ngsi-source", Map.of("producer.override.max.request.size", "16777216"));

        post(source, "large", LARGE);
        post(source, "small", "x");

        assertDeadAndAlive(rig, "default");
    }

    @Test
    void getThroughWhereTheExampleMakesTheTopic() throws Exception {
        SourceOnConnect source = create(rig, "made", "ngsi-source-subscribing", Map.of("context.broker.url", ""));

        post(source, "large", LARGE);

        try (TopicReader reader = new TopicReader(rig.bootstrapServers(), "made")) {
            assertThat(reader.atLeast(1)).extracting(ConsumerRecord::key).containsExactly("large");
        }
    }

    private static SourceOnConnect create(ConnectRig rig, String topic, String example, Map<String, String> options) {
        int port = FreePort.orFree(0);
        Map<String, String> all = new HashMap<>(Map.of("topic", topic, "listen.port", Integer.toString(port)));
        all.putAll(options);
        rig.create(topic, example, all);
        SourceOnConnect source = new SourceOnConnect(port);
        source.awaitListening();
        return source;
    }

    private static void assertDeadAndAlive(ConnectRig rig, String topic) {
        try (TopicReader dead = new TopicReader(rig.bootstrapServers(), topic + ".dead");
                TopicReader reader = new TopicReader(rig.bootstrapServers(), topic)) {
            assertThat(reader.atLeast(1)).extracting(ConsumerRecord::key).containsExactly("small");
            assertThat(dead.atLeast(1)).singleElement().satisfies(letter -> {
                assertThat(new String(
                                letter.headers().lastHeader(DeadLetter.REASON).value(), UTF_8))
                        .isEqualTo("too-large");
                assertThat(new String(letter.value(), UTF_8)).startsWith("{\"id\":\"large\"");
            });
        }
    }

    private static void post(SourceOnConnect source, String id, String text) throws Exception {
        assertThat(source.post(id, "\"" + text + "\"")).isEqualTo(200);
    }

    private static void make(ConnectRig rig, String topic, String maxBytes) {
        NewTopic desired = new NewTopic(topic, Optional.of(1), Optional.empty());
        rig.createTopic(desired.configs(Map.of("max.message.bytes", maxBytes)));
    }

    private static void lower(String topic) throws Exception {
        ConfigResource resource = new ConfigResource(ConfigResource.Type.TOPIC, topic);
        AlterConfigOp lower = new AlterConfigOp(new ConfigEntry("max.message.bytes", MIB), AlterConfigOp.OpType.SET);
        admin.incrementalAlterConfigs(Map.of(resource, List.of(lower))).all().get(60, TimeUnit.SECONDS);
    }
}
