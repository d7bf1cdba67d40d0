package io.furrow.fiware;

import java.io.IOException;
import java.net.URISyntaxException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Instant;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.clock.SettableClock;
import io.furrow.files.Folders;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** The operations behind the notifications that Orion 4.7 was recorded with lead to the same notifications here. */
class RecordedNotificationsTest {
    private static final List<String> FORMATS =
            List.of("normalized", "keyValues", "values", "simplifiedNormalized", "simplifiedKeyValues");
    private static final int SUBSCRIPTIONS = 7;

    private final SettableClock clock = new SettableClock(Instant.EPOCH);

    @AutoClose
    private final NotificationReceiver receiver = new NotificationReceiver();

    @AutoClose
    private final FiwareStandIn standIn = FiwareStandIn.start(FiwareSettings.httpOnly(), clock);

    private final Client client = Client.of(standIn.contextBroker());

    @BeforeEach
    void subscribeAsRecorded() {
        clock.set(Instant.parse("2026-11-21T01:11:00Z"));
        for (String format : FORMATS) {
            subscribe(format, "\"attrsFormat\": \"" + format + "\"");
        }
        subscribe("onlyChanged", """
                "onlyChangedAttrs": true,
                "metadata": ["dateCreated", "dateModified", "actionType", "previousValue", "*"]""");
        subscribe("withdates", "\"attrs\": [\"moisture\", \"dateModified\", \"dateCreated\", \"servicePath\"]");
    }

    @Test
    void notifiesANewEntityAsRecorded() throws Exception {
        createFirst();

        compareWith("create");
    }

    @Test
    void notifiesAPatchedEntityAsRecorded() throws Exception {
        createFirst();
        next();
        clock.set(Instant.parse("2026-11-21T01:11:03.218Z"));

        assertThat(client.patch("/v2/entities/urn:ngsi-ld:SoilProbe:001/attrs", """
                        {"moisture": {"type": "Number", "value": 22.75}}""")
                        .status())
                .isEqualTo(204);

        compareWith("patch");
    }

    @Test
    void notifiesAForcedUpdateAsRecordedAndAnUnforcedOneOfTheSameValueNever() throws Exception {
        clock.set(Instant.parse("2026-11-21T01:11:04.258Z"));
        client.post("/v2/entities", """
                {"id": "urn:ngsi-ld:SoilProbe:002", "type": "SoilProbe", "moisture": {"type": "Number", "value": 30}}""");
        next();
        String same = "{\"moisture\": {\"type\": \"Number\", \"value\": 30.0}}";

        client.patch("/v2/entities/urn:ngsi-ld:SoilProbe:002/attrs", same);
        clock.set(Instant.parse("2026-11-21T01:11:06.328Z"));
        client.patch("/v2/entities/urn:ngsi-ld:SoilProbe:002/attrs?options=forcedUpdate", same);

        compareWith("forced");
    }

    private void createFirst() {
        clock.set(Instant.parse("2026-11-21T01:11:02.174Z"));
        Client.Answer answer = client.with("Fiware-Correlator", "corr-create-1").post("/v2/entities", """
                {"id": "urn:ngsi-ld:SoilProbe:001", "type": "SoilProbe",
                 "moisture": {"type": "Number", "value": 21.5, "metadata": {
                     "TimeInstant": {"type": "DateTime", "value": "2026-11-21T01:00:00Z"},
                     "unitCode": {"type": "Text", "value": "P1"}}},
                 "temperature": {"type": "Number", "value": 18.0},
                 "location": {"type": "geo:json", "value": {"type": "Point", "coordinates": [-3.7, 40.41]}},
                 "TimeInstant": {"type": "DateTime", "value": "2026-11-21T01:00:00Z"}}""");
        assertThat(answer.status()).as(answer.body()).isEqualTo(201);
    }

    private void subscribe(String path, String options) {
        Client.Answer answer = client.post("/v2/subscriptions", """
                {"subject": {"entities": [{"idPattern": ".*", "type": "SoilProbe"}]},
                 "notification": {"http": {"url": "%s"}, %s}}""".formatted(receiver.url("/" + path), options));
        assertThat(answer.status()).as(answer.body()).isEqualTo(201);
    }

    private void next() {
        await().until(() -> receiver.received().size() == SUBSCRIPTIONS);
        receiver.received().clear();
    }

    private void compareWith(String folder) throws IOException, URISyntaxException {
        await().until(() -> receiver.received().size() >= SUBSCRIPTIONS);
        Path recordings = Path.of(getClass().getResource("/orion/" + folder).toURI());
        List<Path> all = Folders.list(recordings);
        assertThat(all).hasSize(SUBSCRIPTIONS);
        for (Path file : all) {
            compare(file, folder.equals("create"));
        }
        assertThat(receiver.received()).hasSize(SUBSCRIPTIONS);
    }

    private void compare(Path file, boolean sameCorrelator) throws IOException {
        String[] parts = Files.readString(file).replace("\r\n", "\n").split("\n\n", 2);
        List<String> head = Arrays.asList(parts[0].split("\n"));
        Map<String, String> expected = new TreeMap<>(String.CASE_INSENSITIVE_ORDER);
        head.stream().skip(1).map(line -> line.split(": ", 2)).forEach(header -> expected.put(header[0], header[1]));
        List<NotificationReceiver.ReceivedNotification> found =
                receiver.at(head.get(0).split(" ")[1]);

        assertThat(found).as(file.toString()).hasSize(1);
        NotificationReceiver.ReceivedNotification notification = found.get(0);
        assertThat(withoutId(notification.body())).isEqualTo(withoutId(parts[1].strip()));
        assertThat(notification.headers().keySet()).containsExactlyElementsOf(expected.keySet());
        for (String name : List.of("""
                        Fiware-Service Fiware-Servicepath Accept Content-Length Content-Type Ngsiv2-AttrsFormat""".split("\\s+"))) {
            assertThat(notification.headers().get(name)).as(name).isEqualTo(expected.get(name));
        }
        String correlator = notification.headers().get("Fiware-Correlator");
        assertThat(correlator).matches("[0-9a-z-]+; cbnotif=\\d");
        String recorded = expected.get("Fiware-Correlator");
        assertThat(sameCorrelator ? correlator : number(correlator))
                .isEqualTo(sameCorrelator ? recorded : number(recorded));
    }

    private static String number(String correlator) {
        return correlator.substring(correlator.indexOf(';'));
    }

    private static String withoutId(String body) {
        return body.replaceFirst("\"subscriptionId\":\"[0-9a-f]{24}\"", "\"subscriptionId\":\"<id>\"");
    }
}
