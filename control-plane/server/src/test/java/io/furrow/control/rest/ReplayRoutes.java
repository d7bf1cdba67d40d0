package io.furrow.control.rest;

import java.net.http.HttpResponse;
import java.util.Properties;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.TimeUnit;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerConfig;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.PartitionInfo;
import org.junit.jupiter.api.Test;

import io.furrow.kafka.KafkaClients;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

/** Tests {@code /api/replays}. */
interface ReplayRoutes extends RestApiRoutes {
    @Test
    default void controlsAReplay() throws Exception {
        JsonNode created = client().ask("POST", "/api/replays", "{\"mission\":\"hoeing\",\"speed\":\"max\"}");
        String replay = "/api/replays/" + created.path("replay").asText();
        assertThat(running().get(replay).path("wanted").asText()).isEqualTo("running");
        assertThat(client().ask("POST", replay + "/pause", null).path("status").asText())
                .isEqualTo("paused");
        assertThat(client().status("POST", replay + "/step", "{\"count\":3}")).isEqualTo(200);
        assertThat(client().status("POST", replay + "/seek", "{\"to\":1700000000000}"))
                .isEqualTo(200);
        assertThat(client().status("POST", replay + "/speed", "{\"speed\":2}")).isEqualTo(200);
        assertThat(client().status("POST", replay + "/resume", null)).isEqualTo(200);
        assertThat(running().get("/api/replays").findValuesAsText("replay"))
                .contains(created.path("replay").asText());
        running().rejects("POST", replay + "/step", "{}", 409, "wrong-state");
        running().rejects("POST", replay + "/dance", null, 404, "not-found");
        assertThat(client().status("DELETE", replay, null)).isEqualTo(200);
        running().rejects("GET", "/api/replays/hoeing.00000000", null, 404, "unknown-replay");
    }

    /** The transaction hides what is written after it on its partitions. */
    @Test
    default void answersOnceTheReplayIsVisibleBehindAnOpenTransaction() throws Exception {
        Properties settings = new Properties();
        settings.putAll(running().settings().client());
        settings.put(ProducerConfig.TRANSACTIONAL_ID_CONFIG, "open");
        try (KafkaProducer<String, byte[]> other = KafkaClients.producer(settings)) {
            other.initTransactions();
            other.beginTransaction();
            for (PartitionInfo each : other.partitionsFor(Topics.REPLAYS)) {
                other.send(new ProducerRecord<>(Topics.REPLAYS, each.partition(), "open", new byte[0]));
            }
            other.flush();
            CompletableFuture.delayedExecutor(2, TimeUnit.SECONDS).execute(other::abortTransaction);

            String replay = client().ask("POST", "/api/replays", "{\"mission\":\"hoeing\"}")
                    .path("replay")
                    .asText();
            assertThat(running().get("/api/replays").findValuesAsText("replay")).contains(replay);
            assertThat(client().status("DELETE", "/api/replays/" + replay, null))
                    .isEqualTo(200);
        }
    }

    @Test
    default void controlsAReplayWithAllOptions() throws Exception {
        HttpResponse<byte[]> created = client().send("POST", "/api/replays", """
                {"mission": "ridging", "topic": "data.show.replay.0000cafe", "from": 0, "to": 9000, "range": {"from": 1000, "to": 2000},
                 "maxGap": "PT5S", "stamps": "now", "startAt": 1700000000000, "analytics": ["presence"], "source": {"file": "a.jsonl"}}
                """);
        assertThat(created.statusCode()).as(new String(created.body())).isEqualTo(201);
        String replay = "/api/replays/ridging.0000cafe";
        assertThat(created.headers().firstValue("Location")).contains(replay.replace("/api/", ""));
        assertThat(running().get(replay).at("/range/to").asLong()).isEqualTo(2000);
        assertThat(running().get(replay).path("stamps").asText()).isEqualTo("now");
        assertThat(running().get(replay).at("/source/file").asText()).isEqualTo("a.jsonl");

        assertThat(client().status("POST", replay + "/loop", "{\"from\":3000,\"to\":4000}"))
                .isEqualTo(200);
        assertThat(running().get(replay).at("/range/to").asLong()).isEqualTo(4000);
        assertThat(client().status("POST", replay + "/loop", null)).isEqualTo(200);
        assertThat(running().get(replay).has("range")).isFalse();
        running().rejects("POST", replay + "/pause", "{\"to\":5}", 400, "wrong-member");
        running()
                .rejects(
                        "POST",
                        "/api/replays",
                        "{\"mission\":\"ridging\",\"topic\":\"data.show.replay.0000cafe\"}",
                        409,
                        "replay-exists");
        assertThat(client().status("GET", replay + "/events", null)).isEqualTo(200);
        assertThat(client().status("GET", "/api/replays/events", null)).isEqualTo(200);
        running().rejects("GET", "/api/replays/ridging.00000000/events", null, 404, "unknown-replay");
        assertThat(running().get("/api/recordings")).isEmpty();
    }

    @Test
    default void controlsAGroupOfReplays() throws Exception {
        HttpResponse<byte[]> created = client().send(
                        "POST", "/api/replays", "{\"missions\":[\"sowing\",\"rolling\"],\"from\":1000,\"to\":900000}");
        assertThat(created.statusCode()).as(new String(created.body())).isEqualTo(201);
        String group =
                "/api/replays/groups/" + client().json(created).path("group").asText();
        assertThat(created.headers().firstValue("Location")).contains(group.replace("/api/", ""));
        assertThat(running().get(group).findValuesAsText("mission")).containsExactly("rolling", "sowing");

        assertThat(client().status("POST", group + "/pause", null)).isEqualTo(200);
        assertThat(client().status("POST", group + "/seek", "{\"to\":5000}")).isEqualTo(200);
        assertThat(running().get(group).get(0).at("/clock/shows").asLong()).isEqualTo(5000);
        running().rejects("POST", group + "/step", "{}", 409, "wrong-state");
        running().rejects("GET", "/api/replays/groups/0a1b2c3d", null, 404, "unknown-replay");
        assertThat(client().status("DELETE", group, null)).isEqualTo(200);
        assertThat(running().get(group).findValuesAsText("wanted")).containsExactly("stopped", "stopped");
    }
}
