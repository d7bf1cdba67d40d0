package io.furrow.cli.control;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Clock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Properties;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;

import io.furrow.cli.Commands;
import io.furrow.control.ControlPlane;
import io.furrow.control.ControlSettings;
import io.furrow.control.rest.RestApi;
import io.furrow.control.rest.RestSettings;
import io.furrow.control.rest.access.CertificateFiles;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.SelfSignedCertificate;
import io.furrow.kafka.Readiness;
import io.furrow.kafka.secret.SecretSource;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

class ControlCommandsIT {
    @TempDir
    static Path directory;

    private static EmbeddedKafka kafka;
    private static ControlPlane plane;
    private static RestApi api;
    private static SelfSignedCertificate certificate;
    private static FarmSecret secret;

    private final StringWriter out = new StringWriter();
    private final StringWriter err = new StringWriter();

    @BeforeAll
    static void start() throws Exception {
        kafka = EmbeddedKafka.start(directory.resolve("kafka"));
        Properties client = kafka.client();
        ControlSettings settings = ControlSettings.of(client);
        plane = ControlPlane.start(settings);
        Path tokens = Files.writeString(directory.resolve("tokens"), "ann a-token-of-some-length admin\n");
        certificate = SelfSignedCertificate.make(directory, "control-plane");
        secret = FarmSecret.generate();
        RestSettings rest = RestSettings.on(0)
                .withTokens(tokens)
                .withCertificate(CertificateFiles.pem(certificate.certificate(), certificate.key()))
                .withSecret(SecretSource.of(secret));
        api = RestApi.start(settings, rest, new Readiness(Clock.systemUTC()));
        Files.writeString(directory.resolve("token"), "a-token-of-some-length\n");
    }

    @AfterAll
    static void stop() {
        api.close();
        plane.close();
        kafka.close();
    }

    @Test
    void createsChangesListsAndDeletesDomains() throws Exception {
        Path area = Files.writeString(
                directory.resolve("area.json"),
                "{\"type\":\"Polygon\",\"coordinates\":[[[-3.49,40.31],[-3.48,40.31],[-3.48,40.32],[-3.49,40.31]]]}");

        assertThat(run("domain", "create", "north", "--name", "North", "--area", area.toString()))
                .contains("created", "domain north", "data.north.realtime");
        run("domain", "change", "north", "--description", "Behind the hill", "--fields", "f-1,f-2");
        await().untilAsserted(
                        () -> assertThat(run("domain", "list")).containsPattern("north +North +Behind the hill +2 "));
        assertThat(json("domain", "show", "north").at("/area/type").asText()).isEqualTo("Polygon");
        assertThat(refused("domain", "create", "north")).contains("north", "domain-exists");
        assertThat(run("domain", "delete", "north"))
                .contains("deleted: domain north; missions deleted: none; fields ended: none");
        assertThat(refused("domain", "delete", "north")).contains("there is no domain 'north'", "unknown-domain");
        await().untilAsserted(() -> assertThat(run("audit", "--user", "ann").lines())
                .anyMatch(line -> line.matches(".*Z +ann +service.domainmanager +delete +deleted +domain north.*")));
    }

    /** One of many ways to the manager: the others are tested without a control plane. */
    @Test
    void renamesEndsAndDeletesFields() throws Exception {
        Path file = Files.writeString(
                directory.resolve("fields.geojson"),
                "{\"type\":\"FeatureCollection\",\"features\":[%s,%s]}".formatted(field("west"), field("east")));
        onKafka("fields", "import", file.toString(), "--domain", "hill");
        run("domain", "create", "hill");

        assertThat(run("fields", "rename", "west", "--name", "Behind the barn"))
                .contains("Field west is now called Behind the barn.");
        assertThat(onKafka("fields", "list")).containsPattern("west +Behind the barn +hill +\\S+ +Polygon");
        assertThat(run("fields", "end", "west", "--at", "2999-01-01T00:00:00+01:00"))
                .contains("Field west ends at 2998-12-31T23:00:00Z.");
        assertThat(run("domain", "delete", "hill")).contains("fields ended: 2 (east, west)");
        assertThat(onKafka("fields", "list")).startsWith("There are no fields.");
        assertThat(refused("fields", "end", "west")).contains("field 'west' ended at", "wrong-state");
        assertThat(refused("fields", "end", "nosuch")).contains("there is no field 'nosuch'; there are: east, west");
        assertThat(run("fields", "delete", "west")).contains("Field west is deleted, with its");
        assertThat(refused("fields", "delete", "west")).contains("unknown-field");
        assertThat(onKafka("fields", "list", "--versions")).doesNotContain("west");
    }

    private static String field(String id) {
        return "{\"type\":\"Feature\",\"id\":\"%s\",\"properties\":{},\"geometry\":{\"type\":\"Polygon\",".formatted(id)
                + "\"coordinates\":[[[0,0],[0.01,0],[0.01,0.01],[0,0]]]}}";
    }

    @Test
    void takesAMissionThroughItsLifeAndFollowsIt() throws Exception {
        Path devices = Files.writeString(directory.resolve("devices.json"), "[\"urn:ngsi-ld:Robot:7\"]");
        run("domain", "create", "farm");

        assertThat(run("mission", "create", "weeding", "--domain", "farm", "--devices", devices.toString()))
                .contains("created: mission weeding");
        await().untilAsserted(() ->
                assertThat(run("mission", "list", "--domain", "farm")).containsPattern("weeding +farm +- +created"));
        run("mission", "start", "weeding", "--at", Long.toString(System.currentTimeMillis()));
        assertThat(run("mission", "watch", "weeding", "--until", "starting")).contains("starting", "0/1 devices");
        assertThat(run("device", "list", "--mission", "weeding")).contains("urn:ngsi-ld:Robot:7", "running");
        assertThat(refused("mission", "start", "weeding")).contains("mission-running");
        assertThat(run("mission", "stop", "weeding")).contains("stopped: mission weeding");
        assertThat(run("mission", "watch", "weeding")).contains("stopped");
        assertThat(run("mission", "delete", "weeding")).contains("deleted: mission weeding");
        assertThat(refused("mission", "stop", "weeding")).contains("there is no mission 'weeding'", "unknown-mission");
        assertThat(refused("mission", "create", "m.1", "--domain", "farm")).contains("illegal-name");
    }

    @Test
    void givesADeviceNewCredentials() throws Exception {
        Path devices = Files.writeString(directory.resolve("thermometers.json"), "[{\"type\":\"Thermometer\"}]");
        run("domain", "create", "barn");
        run("mission", "start", "drying", "--domain", "barn", "--devices", devices.toString());
        String device = "urn:ngsi-ld:Thermometer:drying-1";
        await().untilAsserted(() -> assertThat(run("device", "credentials", device))
                .contains(secret.device("drying", device).password()));

        assertThat(run("device", "rotate", device))
                .contains(
                        secret.device("drying", device, 1).user(),
                        secret.device("drying", device, 1).password());
        assertThat(json("device", "credentials", device).path("generation").asInt())
                .isEqualTo(1);
        assertThat(refused("device", "rotate", "urn:nosuch")).contains("there is no device", "unknown-device");
    }

    @Test
    void carriesATemplateOutAndBackIn() throws Exception {
        Path file = directory.resolve("template.json");
        await().untilAsserted(() -> assertThat(run("template", "list")).contains("thesis-demo"));

        run("template", "export", "thesis-demo", file.toString());
        assertThat(NgsiJson.read(Files.readAllBytes(file)).path("devices")).isNotEmpty();
        assertThat(run("template", "import", file.toString())).contains("created: template thesis-demo, version 2");
        assertThat(run("template", "delete", "thesis-demo@2")).contains("deleted: template thesis-demo");
        assertThat(refused("template", "export", "nosuch")).contains("unknown-template");
    }

    @Test
    void requestsReplaysAndSteersThem() throws Exception {
        String replay = json("replay", "start", "weeding", "--speed", "10", "--loop")
                .path("replay")
                .asText();

        assertThat(replay).matches("weeding\\.[0-9a-f]{8}");
        assertThat(run("replay", "pause", replay)).contains("paused");
        assertThat(run("replay", "step", replay, "5")).contains("paused");
        assertThat(run("replay", "speed", replay, "max")).contains(replay);
        assertThat(run("replay", "resume", replay)).contains("running");
        assertThat(refused("replay", "speed", replay, "fast")).contains("speed", "wrong-member");
        assertThat(run("replay", "stop", replay)).contains("stopped: replay " + replay);
    }

    @Test
    void listsOpenAlarmsTheMostSevereFirstAndNoMoreThanAreRequested() throws Exception {
        long hours = System.currentTimeMillis() - Duration.ofHours(3).toMillis();
        long days = System.currentTimeMillis() - Duration.ofDays(4).toMillis();
        try (KafkaProducer<String, byte[]> producer = new KafkaProducer<>(
                Map.of("bootstrap.servers", kafka.bootstrapServers()),
                new StringSerializer(),
                new ByteArraySerializer())) {
            send(producer, "silent-device-1", "minor", "open", hours);
            send(producer, "collision-2", "critical", "open", days);
            send(producer, "collision-3", "critical", "open", hours);
            send(producer, "collision-4", "critical", "closed", hours);
            send(producer, "collision-5", "critical", "acknowledged", hours);
        }
        await().untilAsserted(() ->
                assertThat(json("alarm", "list", "--state", "all")).hasSize(5));
        assertThat(run("alarm", "list").lines())
                .satisfiesExactly(
                        line -> assertThat(line).startsWith("ALARM"),
                        line -> assertThat(line).containsPattern("collision-3 +critical +open +3h "),
                        line -> assertThat(line).containsPattern("collision-2 +critical +open +4d "),
                        line -> assertThat(line).containsPattern("silent-device-1 +minor +open +3h "));
        assertThat(run("alarm", "list", "--limit", "1").lines())
                .satisfiesExactly(
                        line -> assertThat(line).startsWith("ALARM"),
                        line -> assertThat(line).startsWith("collision-3"),
                        line -> assertThat(line).isEqualTo("There are more than 1; --limit shows more of them."));
        assertThat(json("alarm", "list", "--limit", "2")).hasSize(2);
        assertThat(run("alarm", "list", "--state", "closed"))
                .contains("collision-4")
                .doesNotContain("collision-5");
        assertThat(run("alarm", "list", "--state", "acknowledged")).contains("collision-5");
        assertThat(run("alarm", "list", "--from", "-1h"))
                .contains("collision-5")
                .doesNotContain("collision-4");
        assertThat(run("alarm", "show", "collision-4")).contains("State:          closed");
        assertThat(refused("alarm", "show", "collision-9")).contains("there is no alarm 'collision-9'");
        assertThat(refused("alarm", "list", "--state", "opne")).contains("--state", "opne", "ACKNOWLEDGED");
        assertThat(refused("alarm", "list", "--limit", "0")).contains("--limit");
    }

    private static void send(
            KafkaProducer<String, byte[]> producer, String alarm, String severity, String state, long raised) {
        String json =
                "{'alarm':'%s','kind':'collision','subject':'a-b','severity':'%s','state':'%s','text':'close','raised':%d}"
                        .formatted(alarm, severity, state, raised)
                        .replace('\'', '"');
        producer.send(
                new ProducerRecord<>(Topics.ALARMS, alarm, json.getBytes(java.nio.charset.StandardCharsets.UTF_8)));
    }

    @Test
    void listsShowsAndRedrivesDeadLetters() throws Exception {
        String message = "no JSON: " + "x".repeat(90);
        try (KafkaProducer<String, byte[]> producer = new KafkaProducer<>(
                Map.of("bootstrap.servers", kafka.bootstrapServers()),
                new StringSerializer(),
                new ByteArraySerializer())) {
            producer.partitionsFor("sown");
            for (String source : List.of("sown-0@7", "192.168.0.7 /ngsi/farm")) {
                ProducerRecord<String, byte[]> letter =
                        new ProducerRecord<>("sown.dead", 0, "robot", "{\"id\":".getBytes());
                new DeadLetter(Reason.NOT_JSON, message, source.startsWith("sown") ? "ingest" : "ngsi-source", source)
                        .headers()
                        .forEach((name, text) -> letter.headers().add(name, text.getBytes()));
                producer.send(letter).get();
            }
        }

        assertThat(run("dead-letters", "list", "--topic", "sown.dead").lines())
                .satisfiesExactly(
                        line -> assertThat(line).containsPattern("sown.dead-0@1  20\\S+Z  not-json  ngsi-source"),
                        line -> assertThat(line).isEqualTo("  " + message),
                        line -> assertThat(line).containsPattern("sown.dead-0@0  20\\S+Z  not-json  ingest"),
                        line -> assertThat(line).startsWith("  no JSON"));
        assertThat(run("dead-letters", "list", "--stage", "ingest", "--limit", "1"))
                .contains("sown.dead-0@0")
                .doesNotContain("There may be more");
        assertThat(run("dead-letters", "list", "--topic", "sown.dead", "--limit", "1"))
                .contains("sown.dead-0@1", "There may be more;");
        assertThat(run("dead-letters", "show", "sown.dead-0@0"))
                .contains("source   sown-0@7", "  dead-stage: ingest", "value, as text", "{\"id\":");
        assertThat(json("dead-letters", "show", "sown.dead-0@1").path("stage").asText())
                .isEqualTo("ngsi-source");
        assertThat(refused("dead-letters", "show", "sown.dead-0@2")).contains("unknown-dead-letter");
        assertThat(refused("dead-letters", "show", "sown.dead")).contains("<topic>-<partition>@<offset>");
        assertThat(run("dead-letters", "redrive", "--topic", "sown.dead", "--dry-run"))
                .contains("would send 1 dead letter from sown.dead to sown: 1 not-json");
        assertThat(run("dead-letters", "redrive", "--topic", "sown.dead"))
                .contains(
                        "sent 1 dead letter from sown.dead to sown",
                        "left where they are: 1 from notifications to the NGSI source");
    }

    @Test
    void showsHowItIsAndWhichRecordsThereAre() throws Exception {
        run("domain", "create", "meadow");

        assertThat(json("status").path("deadLetters").isObject()).isTrue();
        assertThat(run("topic", "list")).containsPattern("service.domains +[0-9]+ +[0-9]+");
        assertThat(run("topic", "tail", "service.domains", "--key", "meadow"))
                .containsPattern("service.domains-[0-9]+@[0-9]+ +\\S+ +meadow +\\{");
        String place = json("topic", "find", "service.domains", "--text", "meadow")
                .path(0)
                .path("offset")
                .asText();
        assertThat(place).matches("[0-9]+");
        assertThat(json("domain", "show", "meadow").path("created").asText()).contains("T");
        assertThat(refused("topic", "tail", "data.raw.dead")).contains("/api/dead-letters");
    }

    @Test
    void reportsWhatToDoWhereItIsNotLetInOrNobodyIsThere() {
        CommandLine furrow = furrow();

        String trusted = certificate.certificate().toString();
        assertThat(furrow.execute("domain", "list", "--api", api.uri().toString(), "--api-ca", trusted))
                .isNotZero();
        assertThat(furrow.execute("domain", "list", "--api", api.uri().toString()))
                .isNotZero();
        assertThat(furrow.execute("domain", "list", "--api", "http://127.0.0.1:1"))
                .isNotZero();
        assertThat(furrow.execute("domain", "list", "--token-file", "nosuch")).isNotZero();

        assertThat(err.toString().lines().toList())
                .satisfiesExactly(
                        line -> assertThat(line).contains("asks who you are", "--token-file"),
                        line -> assertThat(line).contains(api.uri() + " cannot be trusted", "--api-ca"),
                        line -> assertThat(line).contains("No control plane answers at http://127.0.0.1:1", "--api"),
                        line -> assertThat(line).contains("--token-file nosuch cannot be read"),
                        line -> assertThat(line).startsWith("See: furrow domain list --help"));
    }

    private JsonNode json(String... arguments) throws Exception {
        List<String> all = new ArrayList<>(List.of(arguments));
        all.addAll(List.of("--output", "json"));
        return NgsiJson.read(run(all.toArray(new String[0])).getBytes(java.nio.charset.StandardCharsets.UTF_8));
    }

    private String run(String... arguments) {
        out.getBuffer().setLength(0);
        assertThat(furrow().execute(withAccess(arguments))).as("%s", err).isZero();
        return out.toString();
    }

    private String onKafka(String... arguments) {
        out.getBuffer().setLength(0);
        List<String> all = new ArrayList<>(List.of(arguments));
        all.addAll(List.of("--kafka", kafka.bootstrapServers()));
        assertThat(furrow().execute(all.toArray(String[]::new))).as("%s", err).isZero();
        return out.toString();
    }

    private String refused(String... arguments) {
        err.getBuffer().setLength(0);
        assertThat(furrow().execute(withAccess(arguments))).as("%s", out).isNotZero();
        return err.toString();
    }

    private static String[] withAccess(String... arguments) {
        List<String> all = new ArrayList<>(List.of(arguments));
        all.addAll(List.of(
                "--api", api.uri().toString(),
                "--api-ca", certificate.certificate().toString(),
                "--token-file", directory.resolve("token").toString()));
        return all.toArray(new String[0]);
    }

    private CommandLine furrow() {
        return Commands.commandLine(CommandSpec.create().name("furrow"), Commands.ALL)
                .setOut(new PrintWriter(out, true))
                .setErr(new PrintWriter(err, true));
    }
}
