package io.furrow.fiware;

import java.io.IOException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.time.Duration;
import java.time.Instant;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.EnumSource;

import io.furrow.fiware.FiwareSettings.Connections;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** What a client may ask of a subscription, and what it is notified of its life. */
class SubscriptionOptionsTest {
    @AutoClose
    private final NotificationReceiver receiver = new NotificationReceiver();

    @AutoClose
    private final FiwareStandIn standIn = FiwareStandIn.start(FiwareSettings.httpOnly());

    private final Client client = Client.of(standIn.contextBroker());

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "''                               | 1 3",
                "\"entityCreate\"                 | 1",
                "\"entityChange\"                 | 3",
                "\"entityUpdate\"                 | 2 3",
                "\"entityDelete\"                 | 4",
                "\"entityCreate\",\"entityDelete\" | 1 4",
            })
    void notifiesTheAlterationsThatAreRequested(String types, String steps) {
        String condition = types.isEmpty() ? "{}" : "{\"alterationTypes\": [" + types + "]}";
        subscribe(condition, "\"attrs\": [\"step\", \"alterationType\"]", http("/asked"));
        subscribe("{\"alterationTypes\": [\"entityDelete\"]}", "\"attrs\": []", http("/end"));

        client.post("/v2/entities?options=keyValues", "{\"id\": \"P\", \"type\": \"Probe\", \"step\": 1}");
        client.patch("/v2/entities/P/attrs?options=keyValues", "{\"step\": 1}");
        client.patch("/v2/entities/P/attrs?options=keyValues", "{\"step\": 3}");
        client.delete("/v2/entities/P");

        int count = steps.split(" ").length;
        await().until(() ->
                receiver.at("/asked").size() == count && receiver.at("/end").size() == 1);
        assertThat(receiver.at("/asked").stream().map(SubscriptionOptionsTest::step))
                .containsExactlyInAnyOrder(steps.split(" "));
    }

    /** As in Orion's own test of entityDelete. */
    @Test
    void showsADeletedEntityAsItWas() {
        subscribe("{\"alterationTypes\": [\"entityDelete\"]}", "\"attrs\": [\"alterationType\", \"*\"]", http("/end"));
        client.post("/v2/entities", "{\"id\": \"E\", \"type\": \"T\", \"A\": {\"value\": 2, \"type\": \"Number\"}}");

        client.delete("/v2/entities/E");

        await().until(() -> !receiver.at("/end").isEmpty());
        assertThat(receiver.at("/end").get(0).json().path("data").get(0)).hasToString("""
                {"id":"E","type":"T","alterationType":{"type":"Text","value":"entityDelete","metadata":{}},\
                "A":{"type":"Number","value":2,"metadata":{}}}""");
    }

    @Test
    void sendsOnlyWhatChanged() {
        subscribe("{}", "\"onlyChangedAttrs\": true, \"attrsFormat\": \"keyValues\"", http("/changed"));
        client.post("/v2/entities?options=keyValues", "{\"id\": \"P\", \"type\": \"Probe\", \"a\": 1, \"b\": 1}");

        client.patch("/v2/entities/P/attrs?options=keyValues", "{\"a\": 1, \"b\": 2}");

        await().until(() -> receiver.received().size() == 2);
        assertThat(receiver.received().get(1).json().path("data").get(0))
                .hasToString("{\"id\":\"P\",\"type\":\"Probe\",\"b\":2}");
    }

    @Test
    void choosesByPatternsOfIdAndType() {
        create("""
                {"subject": {"entities": [{"idPattern": "[13]$", "typePattern": "^P"}]},
                 "notification": {%s}}""".formatted(http("/")));

        for (String entity : List.of("e1 Probe", "e2 Probe", "e3 Pump", "e3 Lamp")) {
            client.post("/v2/entities", "{\"id\": \"%s\", \"type\": \"%s\"}".formatted((Object[]) entity.split(" ")));
        }

        await().until(() -> receiver.received().size() >= 2);
        assertThat(receiver.received().stream()
                        .map(one -> one.json().path("data").get(0).path("id").asText()))
                .containsExactlyInAnyOrder("e1", "e3");
    }

    @Test
    void countsFailuresUntilASuccessAndReportsTheirReason() throws IOException {
        int port = closedPort();
        String location = subscribe("{}", "\"attrs\": []", "\"http\": {\"url\": \"http://127.0.0.1:" + port + "/\"}");
        client.post("/v2/entities", "{\"id\": \"P\", \"type\": \"Probe\"}");
        await().until(() -> notification(location).path("failsCounter").asInt() == 1);
        JsonNode failed = notification(location);
        assertThat(failed.path("timesSent").asInt()).isEqualTo(1);
        assertThat(failed.path("lastFailure").asText()).endsWith(".000Z");
        assertThat(failed.path("lastFailureReason").asText()).isNotBlank();

        client.patch(location, "{\"notification\": {" + http("/") + "}}");
        client.post("/v2/entities", "{\"id\": \"Q\", \"type\": \"Probe\"}");

        await().until(() -> notification(location).has("lastSuccess"));
        JsonNode succeeded = notification(location);
        assertThat(succeeded.has("failsCounter")).isFalse();
        assertThat(succeeded.path("timesSent").asInt()).isEqualTo(2);
        assertThat(succeeded.path("lastSuccessCode").asInt()).isEqualTo(200);
        assertThat(succeeded.has("lastFailure")).isTrue();
    }

    @Test
    void resumesWhatFailuresHadStoppedWhenItIsSetActive() throws IOException {
        String dead = "\"http\": {\"url\": \"http://127.0.0.1:" + closedPort() + "/\"}";
        String location = subscribe("{}", "\"maxFailsLimit\": 1", dead);
        for (int i = 0; i < 3; i++) {
            client.post("/v2/entities", "{\"id\": \"P" + i + "\", \"type\": \"Probe\"}");
            int failures = Math.min(i + 1, 2);
            await().until(() -> notification(location).path("failsCounter").asInt() == failures);
        }
        assertThat(status(location)).isEqualTo("inactive");
        client.patch(location, "{\"notification\": {" + http("/") + "}}");
        assertThat(status(location)).isEqualTo("inactive");

        client.patch(location, "{\"status\": \"active\"}");

        assertThat(status(location)).isEqualTo("active");
        assertThat(notification(location).has("failsCounter")).isFalse();
        client.post("/v2/entities", "{\"id\": \"after\", \"type\": \"Probe\"}");
        await().until(() -> receiver.received().size() == 1);
    }

    @Test
    void resumesWhatHadExpiredWhenItIsGivenAnotherEnd() {
        String location = create("""
                {"expires": "2020-01-01T00:00:00Z", "subject": {"entities": [{"idPattern": ".*"}]},
                 "notification": {%s}}""".formatted(http("/")));
        assertThat(status(location)).isEqualTo("expired");

        client.patch(location, "{\"expires\": \"" + Instant.now().plus(Duration.ofHours(1)) + "\"}");
        assertThat(status(location)).isEqualTo("active");
        client.post("/v2/entities", "{\"id\": \"P\", \"type\": \"Probe\"}");
        await().until(() -> receiver.received().size() == 1);

        client.patch(location, "{\"expires\": \"\"}");
        assertThat(client.get(location).json().has("expires")).isFalse();
    }

    @ParameterizedTest
    @EnumSource(Connections.class)
    void reusesConnectionsOrMakesANewOneForEachNotification(Connections connections) {
        try (FiwareStandIn other = FiwareStandIn.start(FiwareSettings.httpOnly().withConnections(connections))) {
            Client there = Client.of(other.contextBroker());
            there.post("/v2/subscriptions", """
                    {"subject": {"entities": [{"idPattern": ".*"}]}, "notification": {%s}}""".formatted(http("/")));
            for (int i = 0; i < 5; i++) {
                there.post(
                        "/v2/entities?options=keyValues,upsert",
                        "{\"id\": \"P\", \"type\": \"Probe\", \"i\": " + i + "}");
                int sent = i + 1;
                await().until(() -> other.counters().notificationsSent() == sent);
            }
        }

        assertThat(receiver.received().stream()
                        .map(NotificationReceiver.ReceivedNotification::sender)
                        .distinct())
                .hasSize(connections == Connections.TRANSIENT ? 5 : 1);
        assertThat(receiver.received())
                .allSatisfy(one -> assertThat(one.headers()).doesNotContainKey("Connection"));
    }

    private String subscribe(String condition, String options, String target) {
        return create("""
                {"subject": {"condition": %s, "entities": [{"idPattern": ".*"}]}, "notification": {%s, %s}}""".formatted(condition, options, target));
    }

    private String create(String subscription) {
        Client.Answer answer = client.post("/v2/subscriptions", subscription);
        assertThat(answer.status()).as(answer.body()).isEqualTo(201);
        return answer.location();
    }

    private String http(String path) {
        return "\"http\": {\"url\": \"" + receiver.url(path) + "\"}";
    }

    private JsonNode notification(String location) {
        return client.get(location).json().path("notification");
    }

    private String status(String location) {
        return client.get(location).json().path("status").asText();
    }

    /** The number of the step; a deletion is the fourth, an update without a change the second. */
    private static String step(NotificationReceiver.ReceivedNotification one) {
        JsonNode entity = one.json().path("data").get(0);
        return switch (entity.at("/alterationType/value").asText()) {
            case "entityDelete" -> "4";
            case "entityUpdate" -> "2";
            default -> entity.at("/step/value").asText();
        };
    }

    private static int closedPort() throws IOException {
        try (ServerSocket socket = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            return socket.getLocalPort();
        }
    }
}
