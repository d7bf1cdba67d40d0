package io.furrow.cli.control;

import java.time.Duration;
import java.util.List;
import java.util.Map;

import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import picocli.CommandLine;

import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Commands on alarms, dead letters and topics, and of those who have no access. */
@Tag("full")
class RecordCommandsIT extends CommandsOnControlPlane {
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
}
