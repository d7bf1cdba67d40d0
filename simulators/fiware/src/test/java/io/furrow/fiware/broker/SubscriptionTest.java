package io.furrow.fiware.broker;

import java.io.IOException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.fiware.Client;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.fiware.NotificationReceiver;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

class SubscriptionTest {
    @AutoClose
    private final NotificationReceiver receiver = new NotificationReceiver();

    @AutoClose
    private final FiwareStandIn standIn = FiwareStandIn.start(FiwareSettings.httpOnly());

    private final Client client = Client.of(standIn.contextBroker());

    @Test
    void notifiesEachEntityOfABatchByItself() {
        subscribe("", "");

        batch("agri", 3);

        await().until(() -> receiver.received().size() == 3);
        assertThat(receiver.received())
                .allSatisfy(one -> assertThat(one.json().path("data")).hasSize(1));
        assertThat(receiver.received().stream()
                        .map(one -> one.headers().get("Fiware-Correlator").split("=")[1]))
                .containsExactlyInAnyOrder("1", "2", "3");
    }

    @Test
    void sendsNothingByItselfAndNothingOfAnotherTenantOrPath() {
        client.post("/v2/entities", "{\"id\": \"before\", \"type\": \"Probe\"}");
        subscribe("", "");
        batch("other", 1);
        client.as("agri", "/plot2").post("/v2/entities", "{\"id\": \"elsewhere\", \"type\": \"Probe\"}");
        client.post("/v2/entities", "{\"id\": \"other-type\", \"type\": \"Pump\"}");

        client.post("/v2/entities", "{\"id\": \"here\", \"type\": \"Probe\"}");

        await().until(() -> !receiver.received().isEmpty());
        assertThat(receiver.received()).hasSize(1);
        assertThat(receiver.received().get(0).body()).contains("\"here\"");
    }

    @Test
    void sendsTheHeadersOfACustomNotification() {
        create("""
                {"subject": {"entities": [{"idPattern": ".*"}]}, "notification": {
                    "httpCustom": {"url": "%s", "headers": {"Authorization": "Bearer t", "Accept": ""}}}}""".formatted(receiver.url("/custom")));

        client.post("/v2/entities", "{\"id\": \"P\", \"type\": \"Probe\"}");

        await().until(() -> !receiver.received().isEmpty());
        assertThat(receiver.received().get(0).headers())
                .containsEntry("Authorization", "Bearer t")
                .doesNotContainKey("Accept");
    }

    @Test
    void countsAnyStatusAsSuccessAndSendsOnce() {
        receiver.answering(500);
        String location = subscribe("", "");

        batch("agri", 2);

        await().until(() -> standIn.counters().notificationsSent() == 2);
        assertThat(receiver.received()).hasSize(2);
        JsonNode notification = client.get(location).json().path("notification");
        assertThat(notification.path("timesSent").asInt()).isEqualTo(2);
        assertThat(notification.path("lastSuccessCode").asInt()).isEqualTo(500);
        assertThat(notification.has("failsCounter")).isFalse();
        assertThat(standIn.counters().notificationsFailed()).isZero();
    }

    @Test
    void countsARefusedConnectionAsFailureAndStopsAtTheLimit() throws IOException {
        int closedPort;
        try (ServerSocket socket = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            closedPort = socket.getLocalPort();
        }
        String location = create("""
                {"subject": {"entities": [{"idPattern": ".*"}]},
                 "notification": {"http": {"url": "http://127.0.0.1:%d/"}, "maxFailsLimit": 1}}""".formatted(closedPort));

        batch("agri", 1);
        await().until(() -> standIn.counters().notificationsFailed() == 1);
        assertThat(client.get(location).json().path("status").asText()).isEqualTo("active");
        client.patch("/v2/entities/P0/attrs?options=keyValues", "{\"moisture\": 99}");
        await().until(() -> standIn.counters().notificationsFailed() == 2);

        JsonNode subscription = client.get(location).json();
        assertThat(subscription.at("/notification/failsCounter").asInt()).isEqualTo(2);
        assertThat(subscription.path("notification").has("lastFailure")).isTrue();
        assertThat(subscription.path("notification").has("lastSuccess")).isFalse();
        assertThat(subscription.path("status").asText()).isEqualTo("inactive");
        client.patch(location, "{\"status\": \"active\"}");
        assertThat(client.get(location).json().path("status").asText()).isEqualTo("active");
    }

    @Test
    void keepsAnUpdateFastAndOtherSubscriptionsServedWhenAReceiverHangs() throws IOException {
        try (ServerSocket hanging = new ServerSocket(0, 64, InetAddress.getLoopbackAddress())) {
            create("""
                    {"subject": {"entities": [{"idPattern": ".*"}]}, "notification": {
                        "http": {"url": "http://127.0.0.1:%d/", "timeout": 300}}}""".formatted(hanging.getLocalPort()));
            subscribe("", "");

            batch("agri", 60);

            await().until(() -> receiver.received().size() == 60);
            assertThat(standIn.counters().notificationsQueued()).isPositive();
            await().until(() -> standIn.counters().notificationsFailed() == 60);
            assertThat(standIn.counters().notificationsQueued()).isZero();
        }
    }

    @Test
    void preservesTheOrderOfOneEntity() {
        subscribe("", "\"attrsFormat\": \"values\",");
        batch("agri", 1);
        for (int i = 1; i <= 50; i++) {
            client.patch("/v2/entities/P0/attrs?options=keyValues", "{\"moisture\": " + (100 + i) + "}");
        }

        await().until(() -> receiver.received().size() == 51);
        List<Integer> values = receiver.received().stream()
                .skip(1)
                .map(one -> one.json().path("data").get(0).get(0).intValue())
                .toList();
        assertThat(values).isSorted().doesNotHaveDuplicates();
    }

    @Test
    void staysSilentWhileThrottledExpiredOrInactive() {
        create(subscription("/throttled", "", "").replaceFirst("\\{", "{\"throttling\": 3600, "));
        create(subscription("/expired", "", "").replaceFirst("\\{", "{\"expires\": \"2020-01-01T00:00:00Z\", "));
        create(subscription("/inactive", "", "").replaceFirst("\\{", "{\"status\": \"inactive\", "));
        subscribe("", "");

        batch("agri", 3);

        await().until(() ->
                receiver.at("/notify").size() == 3 && !receiver.at("/throttled").isEmpty());
        assertThat(receiver.at("/throttled")).hasSize(1);
        assertThat(receiver.at("/expired")).isEmpty();
        assertThat(receiver.at("/inactive")).isEmpty();
    }

    @Test
    void notifiesOfADeletedEntityOnlyOnRequest() {
        subscribe("", "");
        create(subscription(
                "/deleted",
                "\"condition\": {\"alterationTypes\": [\"entityDelete\"]},",
                "\"attrs\": [\"alterationType\"],"));
        batch("agri", 1);

        client.delete("/v2/entities/P0");

        await().until(() -> !receiver.at("/deleted").isEmpty());
        assertThat(receiver.at("/deleted").get(0).body()).contains("\"value\":\"entityDelete\"");
        assertThat(receiver.at("/notify")).hasSize(1);
    }

    @Test
    void listsPatchesAndDeletesSubscriptions() {
        String location = subscribe("", "");
        assertThat(client.get("/v2/subscriptions?options=count").total()).isEqualTo("1");
        assertThat(client.as("other", "/plot1").get("/v2/subscriptions").body()).isEqualTo("[]");

        assertThat(client.patch(location, "{\"status\": \"inactive\", \"description\": \"rests\"}")
                        .status())
                .isEqualTo(204);
        JsonNode patched = client.get(location).json();
        assertThat(patched.path("status").asText()).isEqualTo("inactive");
        assertThat(patched.path("description").asText()).isEqualTo("rests");
        assertThat(patched.at("/notification/attrsFormat").asText()).isEqualTo("normalized");
        assertThat(patched.at("/subject/condition/attrs")).isEmpty();

        assertThat(client.delete(location).status()).isEqualTo(204);
        assertThat(client.get(location).status()).isEqualTo(404);
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "notification with 'covered' | '' | 'covered': true,",
                "notification with 'kafka'   | '' | 'kafka': {'url': 'x'},",
                "notification with 'exceptAttrs' | '' | 'exceptAttrs': ['a'],",
                "condition with 'attrs'      | 'condition': {'attrs': ['a']}, | ''",
                "condition with 'expression' | 'condition': {'expression': {'q': 'a>1'}}, | ''",
                "condition with 'notifyOnMetadataChange' false | 'condition': {'notifyOnMetadataChange': false}, | ''",
            })
    void rejectsAnOptionOfOrionThatItDoesNotHave(String example) {
        String[] parts = example.replace("''", "").replace('\'', '"').split("\\|");

        Client.Answer answer = client.post("/v2/subscriptions", subscription("/x", parts[1], parts[2]));

        assertThat(answer.status()).isEqualTo(400);
        assertThat(answer.json().path("description").asText())
                .isEqualTo("not supported by the stand-in: " + parts[0].trim().replace('"', '\''));
    }

    @Test
    void passesOverWhatOrionDoesNotKnow() {
        String location = subscribe("\"nothing\": 1, \"condition\": {\"neither\": 2},", "\"this\": 3,");

        assertThat(client.get(location).body())
                .doesNotContain("nothing", "neither", "this")
                .contains("\"notifyOnMetadataChange\":true", "\"covered\":false");
        assertThat(client.get("/v2/subscriptions/short").status()).isEqualTo(400);
    }

    private String subscribe(String condition, String options) {
        return create(subscription("/notify", condition, options));
    }

    private String subscription(String path, String condition, String options) {
        return """
                {"subject": {%s "entities": [{"idPattern": ".*", "type": "Probe"}]},
                 "notification": {%s "http": {"url": "%s"}}}""".formatted(condition, options, receiver.url(path));
    }

    private String create(String subscription) {
        Client.Answer answer = client.post("/v2/subscriptions", subscription);
        assertThat(answer.status()).as(answer.body()).isEqualTo(201);
        return answer.location();
    }

    private void batch(String service, int size) {
        StringBuilder entities = new StringBuilder();
        for (int i = 0; i < size; i++) {
            entities.append(i == 0 ? "" : ",")
                    .append("{\"id\": \"P" + i + "\", \"type\": \"Probe\", \"moisture\": " + i + "}");
        }
        Client.Answer answer = client.as(service, "/plot1")
                .post(
                        "/v2/op/update?options=keyValues",
                        "{\"actionType\": \"append\", \"entities\": [" + entities + "]}");
        assertThat(answer.status()).as(answer.body()).isEqualTo(204);
    }
}
