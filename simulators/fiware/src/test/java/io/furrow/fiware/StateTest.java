package io.furrow.fiware;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.BasicFileAttributes;
import java.util.Arrays;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.files.Gzip;
import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

@Tag("full")
class StateTest {
    private static final String ENTITY =
            "/v2/entities/t1?attrs=dateCreated,dateModified,*&metadata=dateCreated,dateModified,*";
    private static final String SUBSCRIPTIONS = "/v2/subscriptions";
    private static final String T1 = """
            {"id": "t1", "type": "Probe",
             "zeta": {"value": 18.50, "type": "Number", "metadata": {"unit": {"value": "CEL"}, "at": {"value": 7}}},
             "alpha": {"value": {"n": 3, "list": [1, 2.5, null], "text": "x"}, "type": "StructuredValue"},
             "when": {"value": "2026-11-21T01:00:00Z", "type": "DateTime"}}""";

    /** As deep as a request may be. */
    private static final String DEEP = "{\"id\": \"deep\", \"type\": \"Probe\", \"value\": {\"value\": %s}}"
            .formatted("[".repeat(NgsiJson.MAX_NESTING - 2) + "]".repeat(NgsiJson.MAX_NESTING - 2));

    @TempDir
    private Path directory;

    private Path file() {
        return directory.resolve("made/by/it/fiware.json.gz");
    }

    private FiwareStandIn start() {
        return FiwareStandIn.start(FiwareSettings.httpOnly().withState(file()));
    }

    @Test
    void retainsEntitiesWithTheirDatesTheirMetadataAndTheirOrder() {
        String before;
        try (FiwareStandIn first = start()) {
            Client broker = Client.of(first.contextBroker());
            assertThat(broker.post("/v2/entities", T1).status()).isEqualTo(201);
            broker.as("other", "/").post("/v2/entities", "{\"id\": \"t1\", \"type\": \"Probe\"}");
            broker.post("/v2/entities", DEEP);
            broker.post("/v2/entities", "{\"id\": \"t2\", \"type\": \"Probe\"}");
            broker.delete("/v2/entities/t2");
            before = broker.get(ENTITY).body();
        }

        try (FiwareStandIn second = start()) {
            Client broker = Client.of(second.contextBroker());
            assertThat(before).contains("dateCreated", "\"unit\"", "18.5");
            assertThat(broker.get(ENTITY).body()).isEqualTo(before);
            assertThat(broker.get("/v2/entities?options=count").total()).isEqualTo("2");
            assertThat(broker.as("other", "/").get("/v2/entities/t1").body()).contains("t1");
        }
    }

    @Test
    void distinguishesAChangeFromARepetitionAcrossARestart() {
        try (NotificationReceiver receiver = new NotificationReceiver()) {
            try (FiwareStandIn first = start()) {
                Client.of(first.contextBroker()).post("/v2/entities", T1);
            }
            try (FiwareStandIn second = start()) {
                Client broker = Client.of(second.contextBroker());
                broker.post(SUBSCRIPTIONS, subscription(receiver.url("/")));

                String again = "{" + T1.substring(T1.indexOf("\"zeta\""));
                assertThat(broker.patch("/v2/entities/t1/attrs", again).status())
                        .isEqualTo(204);
                broker.patch("/v2/entities/t1/attrs", "{\"zeta\": {\"value\": 19, \"type\": \"Number\"}}");

                await().until(() -> !receiver.received().isEmpty());
                assertThat(receiver.received()
                                .get(0)
                                .json()
                                .at("/data/0/zeta/value")
                                .asInt())
                        .isEqualTo(19);
            }
        }
    }

    @Test
    void retainsSubscriptionsWithTheirIdsAndCounters() {
        try (NotificationReceiver receiver = new NotificationReceiver()) {
            String before;
            try (FiwareStandIn first = start()) {
                Client broker = Client.of(first.contextBroker());
                broker.post(SUBSCRIPTIONS, subscription(receiver.url("/")));
                broker.post(SUBSCRIPTIONS, subscription(URI.create("http://127.0.0.1:1/")));
                broker.post("/v2/entities", T1);
                await().until(() -> first.counters().notificationsSent() == 1
                        && first.counters().notificationsFailed() == 1);
                await().until(() -> broker.get(SUBSCRIPTIONS).body().contains("lastFailureReason"));
                String failed = broker.get(SUBSCRIPTIONS).json().at("/1/id").asText();
                broker.patch(SUBSCRIPTIONS + "/" + failed, "{\"status\": \"inactive\"}");
                before = broker.get(SUBSCRIPTIONS).body();
            }

            try (FiwareStandIn second = start()) {
                Client broker = Client.of(second.contextBroker());
                assertThat(before).contains("\"timesSent\":1", "lastSuccess", "\"failsCounter\":1", "inactive");
                assertThat(broker.get(SUBSCRIPTIONS).body()).isEqualTo(before);

                broker.patch("/v2/entities/t1/attrs?options=keyValues", "{\"zeta\": 1}");

                await().until(() -> receiver.received().size() == 2);
                assertThat(receiver.received().get(1).json().path("subscriptionId"))
                        .isEqualTo(receiver.received().get(0).json().path("subscriptionId"));
                assertThat(broker.get(SUBSCRIPTIONS)
                                .json()
                                .at("/0/notification/timesSent")
                                .asInt())
                        .isEqualTo(2);
                assertThat(second.counters().notificationsFailed()).isZero();
            }
        }
    }

    @Test
    void retainsGroupsAndDevicesAndWhatADeviceGotFromAGroupThatIsGone() {
        String devices;
        String groups;
        try (FiwareStandIn first = start()) {
            Client agent = Client.of(first.iotAgent());
            agent.post("/iot/services", """
                    {"services": [{"apikey": "k1", "type": "Probe", "commands": [{"name": "on"}]}, {"apikey": "k2"}]}""");
            agent.post("/iot/devices", "{\"devices\": [{\"device_id\": \"d1\", \"apikey\": \"k1\"}]}");
            agent.delete("/iot/services?resource=&apikey=k1");
            devices = agent.get("/iot/devices").body();
            groups = agent.get("/iot/services").body();
        }

        try (FiwareStandIn second = start()) {
            Client agent = Client.of(second.iotAgent());
            Client broker = Client.of(second.contextBroker());
            assertThat(devices).contains("Probe:d1");
            assertThat(groups).contains("k2").doesNotContain("k1");
            assertThat(agent.get("/iot/devices").body()).isEqualTo(devices);
            assertThat(agent.get("/iot/services").body()).isEqualTo(groups);

            broker.post("/v2/entities", "{\"id\": \"Probe:d1\", \"type\": \"Probe\"}");
            broker.patch("/v2/entities/Probe:d1/attrs?options=keyValues", "{\"on\": 1}");

            // Nobody can be reached without MQTT, but it was taken for a command.
            assertThat(broker.value("Probe:d1", "on_status")).hasToString("\"ERROR\"");
        }
    }

    @Test
    void savesWhileItRuns() {
        try (FiwareStandIn standIn = start()) {
            Client.of(standIn.contextBroker()).post("/v2/entities", T1);

            await().until(() -> Files.exists(file()));
        }
    }

    @Test
    void writesOnlyWhenSomethingChanged() throws IOException {
        start().close();
        assertThat(file()).doesNotExist();
        try (FiwareStandIn standIn = start()) {
            Client.of(standIn.contextBroker()).post("/v2/entities", T1);
        }
        Object written = identity();

        try (FiwareStandIn standIn = start()) {
            Client.of(standIn.contextBroker()).get(ENTITY);
        }
        assertThat(identity()).isEqualTo(written);

        try (FiwareStandIn standIn = start()) {
            Client.of(standIn.contextBroker()).delete("/v2/entities/t1");
        }
        assertThat(identity()).isNotEqualTo(written);
    }

    @Test
    void takesNoNoticeOfAFileThatWasNeverFinished() throws IOException {
        String before;
        try (FiwareStandIn first = start()) {
            Client broker = Client.of(first.contextBroker());
            broker.post("/v2/entities", T1);
            before = broker.get(ENTITY).body();
        }
        Files.write(file().resolveSibling("fiware.json.gz.tmp"), half());

        try (FiwareStandIn second = start()) {
            Client broker = Client.of(second.contextBroker());
            assertThat(broker.get(ENTITY).body()).isEqualTo(before);
            broker.delete("/v2/entities/t1");
        }

        try (FiwareStandIn third = start()) {
            assertThat(Client.of(third.contextBroker()).get(ENTITY).status()).isEqualTo(404);
        }
    }

    @ParameterizedTest
    @ValueSource(strings = {"half", "one byte differs", "empty", "no gzip", "other version", "no end", "unknown line"})
    void rejectsADamagedFile(String damage) throws IOException {
        try (FiwareStandIn first = start()) {
            Client.of(first.contextBroker()).post("/v2/entities", T1);
        }
        byte[] damaged = damaged(damage);
        Files.write(file(), damaged);

        assertThatThrownBy(this::start)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContainingAll(file().toString(), "damaged", "move it away");
        assertThat(Files.readAllBytes(file())).isEqualTo(damaged);
    }

    private byte[] damaged(String how) throws IOException {
        return switch (how) {
            case "half" -> half();
            case "one byte differs" -> {
                byte[] bytes = Files.readAllBytes(file());
                // In the check sum, so that only it can tell.
                bytes[bytes.length - 6] ^= 1;
                yield bytes;
            }
            case "empty" -> new byte[0];
            case "no gzip" -> "{\"fiwareState\":1}\n{\"end\":0}".getBytes(UTF_8);
            case "other version" -> Gzip.of("{\"fiwareState\":2}\n{\"end\":0}".getBytes(UTF_8));
            case "no end" -> Gzip.of("{\"fiwareState\":1}".getBytes(UTF_8));
            default -> Gzip.of("{\"fiwareState\":1}\n{\"what\":{}}\n{\"end\":1}".getBytes(UTF_8));
        };
    }

    private byte[] half() throws IOException {
        byte[] whole = Files.readAllBytes(file());
        return Arrays.copyOf(whole, whole.length / 2);
    }

    /** Another one after each write, because the file is replaced. */
    private Object identity() throws IOException {
        BasicFileAttributes attributes = Files.readAttributes(file(), BasicFileAttributes.class);
        return attributes.lastModifiedTime();
    }

    private static String subscription(URI url) {
        return """
                {"subject": {"entities": [{"idPattern": ".*", "type": "Probe"}]},
                 "notification": {"http": {"url": "%s"}}}""".formatted(url);
    }
}
