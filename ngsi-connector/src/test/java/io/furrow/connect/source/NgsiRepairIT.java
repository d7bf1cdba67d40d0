package io.furrow.connect.source;

import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.connect.ConnectRig;
import io.furrow.connect.TopicReader;
import io.furrow.connect.repair.Broker;
import io.furrow.embedded.FreePort;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareSettings.Connections;
import io.furrow.model.ngsi.Entity;
import io.furrow.unchecked.Unchecked;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** A real worker beside the context broker of the simulators, which connects again for each notification. */
class NgsiRepairIT {
    private static final String NAME = "ngsi-source";
    private static final int ENTITIES = 500;
    private static final int UPDATES = 20_000;
    private static final int BATCH = 100;
    private static final int DELETED = 10;

    @TempDir
    static Path directory;

    @AutoClose
    private static ConnectRig rig;

    @AutoClose
    private final Broker broker = new Broker(FiwareSettings.httpOnly().withConnections(Connections.TRANSIENT), "agri");

    @BeforeAll
    static void startWorker() {
        rig = ConnectRig.start(directory);
    }

    @Tag("full")
    @Test
    void bringsTheLatestStateOfAllEntitiesThatChangedWhileItWasDown() {
        source("repaired", FreePort.orFree(0));
        Map<String, Integer> state = new HashMap<>();
        var all = java.util.stream.IntStream.range(0, ENTITIES).boxed().toList();
        update(all.subList(0, ENTITIES / 2), 0, state);
        update(all.subList(ENTITIES / 2, ENTITIES), 0, state);
        try (TopicReader reader = new TopicReader(rig.bootstrapServers(), "repaired")) {
            await().until(() -> latest(reader.atLeast(1)).equals(state));
            await().until(() -> broker.standIn().counters().notificationsQueued() == 0);
            rig.stop(NAME);
            long seed = changeWhileDown(state);
            assertThat(subscription().path("status").asText()).isEqualTo("inactive");

            rig.resume(NAME);

            List<ConsumerRecord<String, byte[]>> seen = new ArrayList<>();
            await().untilAsserted(() -> {
                seen.clear();
                seen.addAll(reader.atLeast(1));
                assertThat(latest(seen)).as("changes of seed %d", seed).isEqualTo(state);
            });
            Map<String, ConsumerRecord<String, byte[]>> last = new HashMap<>();
            seen.forEach(record -> last.put(record.key(), record));
            assertThat(last).hasSize(ENTITIES);
            assertThat(last.values())
                    .extracting(record -> header(record, "origin"))
                    .containsOnly("repair");
            assertThat(last.values())
                    .filteredOn(record -> record.value() == null)
                    .hasSize(DELETED)
                    .extracting(record -> header(record, "ce_type"))
                    .containsOnly("ngsi.entity.deleted");
            await().until(() -> subscription().path("status").asText().equals("active"));

            broker.put("/", "e77", "Probe", -1);
            await().until(() ->
                    reader.atLeast(1).stream().anyMatch(record -> record.key().equals("e77") && value(record) == -1));
        }
    }

    @Tag("full")
    @Test
    void hasOneSubscriptionThroughRestartsAndMovesAndMakesItAgainWhenItIsRemoved() {
        source("kept", FreePort.orFree(0));
        await().until(() -> broker.subscriptions().size() == 1);
        String id = subscription().path("id").asText();

        rig.restart(NAME);
        int port = FreePort.orFree(0);
        source("kept", port);

        await().until(() -> subscription()
                .at("/notification/httpCustom/url")
                .asText()
                .equals("http://127.0.0.1:" + port + "/v2/notify"));
        assertThat(subscription().path("id").asText()).isEqualTo(id);
        broker.send("DELETE", "/v2/subscriptions/" + id, "/#", "");
        broker.put("/", "unnoticed", "Probe", 1);
        await().until(() -> broker.subscriptions().size() == 1);
        try (TopicReader reader = new TopicReader(rig.bootstrapServers(), "kept")) {
            assertThat(reader.atLeast(1))
                    .anySatisfy(record -> assertThat(record.key()).isEqualTo("unnoticed"));
        }
    }

    private void source(String topic, int port) {
        // Each test has a context broker of its own, so what is known of another's entities must not be known here.
        rig.create(
                "ngsi-source-subscribing",
                Map.of(
                        "journal.dir", directory.resolve("journal-" + topic).toString(),
                        "listen.port", Integer.toString(port),
                        "topic", topic,
                        "secret", "known-to-both",
                        "public.url", "",
                        "context.broker.url", broker.uri().toString(),
                        "subscription.tenants", "agri",
                        "subscription.alteration.types", "entityCreate,entityChange,entityDelete",
                        "subscription.max.fails", "5",
                        "subscription.check.interval.ms", "3000"));
        await().until(() -> !broker.subscriptions().isEmpty());
    }

    /** Answers the seed of the changes. */
    private long changeWhileDown(Map<String, Integer> state) {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        for (int done = 0; done < UPDATES; done += BATCH) {
            int value = done;
            var some = random.ints(0, ENTITIES).distinct().limit(BATCH).boxed().toList();
            update(some, value + 1, state);
        }
        for (int i = 0; i < DELETED; i++) {
            broker.delete("/", "e" + i);
            state.put("e" + i, null);
        }
        return seed;
    }

    private void update(List<Integer> entities, int value, Map<String, Integer> state) {
        StringBuilder body = new StringBuilder("{\"actionType\": \"append\", \"entities\": [");
        for (int number : entities) {
            body.append(body.toString().endsWith("[") ? "" : ",")
                    .append("{\"id\": \"e" + number
                            + "\", \"type\": \"Probe\", \"t\": {\"type\": \"Number\", \"value\": " + value + "}}");
            state.put("e" + number, value);
        }
        assertThat(broker.send("POST", "/v2/op/update", "/", body + "]}").statusCode())
                .isEqualTo(204);
    }

    private JsonNode subscription() {
        assertThat(broker.subscriptions()).hasSize(1);
        return broker.subscriptions().get(0);
    }

    private static Map<String, Integer> latest(List<ConsumerRecord<String, byte[]>> records) {
        Map<String, Integer> latest = new HashMap<>();
        records.forEach(record -> latest.put(record.key(), record.value() == null ? null : value(record)));
        return latest;
    }

    private static int value(ConsumerRecord<String, byte[]> record) {
        return Unchecked.get(() -> record.value() == null
                ? 0
                : Entity.parse(record.value()).value("t").orElseThrow().intValue());
    }

    private static String header(ConsumerRecord<String, byte[]> record, String name) {
        return new String(record.headers().lastHeader(name).value(), UTF_8);
    }
}
