package io.furrow.launcher.suite;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Optional;

import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine;

import io.furrow.embedded.EmbeddedFlink;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.kafka.field.FieldsTopic;
import io.furrow.launcher.Furrow;
import io.furrow.launcher.replay.ReplayAnalytics;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.result.AnalyticsKind;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Real analytics jobs beside four replays, on real engines; what they found is compared. */
@Tag("full")
class ReplayAnalyticsIT {
    private static final Duration TIMEOUT = Duration.ofMinutes(3);
    private static final long T0 = 1_777_600_000_000L;
    private static final List<String> IDS = List.of("0000000a", "0000000b", "0000000c", "0000000d");

    private KafkaProducer<String, byte[]> producer;

    @Test
    void runsTheJobsThatReplaysRequestAndEndsThemWithTheReplays(@TempDir Path folder) throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(folder.resolve("kafka"), 0);
                RunDirectory directory = RunDirectory.open(folder.resolve("data"));
                KafkaAccess access = KafkaAccess.to(kafka.bootstrapServers(), null);
                EmbeddedFlink flink = EmbeddedFlink.start(EmbeddedAnalytics.SLOTS, 0);
                KafkaProducer<String, byte[]> writer = new KafkaProducer<>(
                        Map.of("bootstrap.servers", kafka.bootstrapServers()),
                        new StringSerializer(),
                        new ByteArraySerializer())) {
            producer = writer;
            makeTopics(kafka);
            SuiteSettings settings = SuiteSettings.onFreePorts("10s");
            new SuiteFields(new FieldsTopic(access.clientProperties())).write(settings, directory);
            Jobs jobs = new Jobs(flink, directory.resolve("jobs"));
            var analytics = new EmbeddedAnalytics(flink, jobs, new SuiteJobs(settings, access, null, directory));
            for (String id : IDS) {
                addDesired(id, null);
                play(id);
            }

            try (ReplayAnalytics running = ReplayAnalytics.start(access.clientProperties(), analytics)) {
                await().atMost(TIMEOUT)
                        .until(() -> analytics.running().size(), size -> size == EmbeddedAnalytics.SLOTS);
                addDesired("0000000e", null);
                await().atMost(TIMEOUT).until(() -> !running.waiting().isEmpty());

                for (String id : List.of("0000000a", "0000000b", "0000000c", "0000000d", "0000000e")) {
                    addDesired(id, ReplayStatus.State.ENDED);
                }
                await().atMost(TIMEOUT).until(() -> analytics.running().isEmpty());
            }

            assertThat(directory.resolve("jobs").toFile().list()).isEmpty();
            assertThat(compare(kafka, "weeding.0000000a", "weeding.0000000b"))
                    .contains("ENCOUNTERS  1 same, 0 changed", "STAYS  2 same", "A and B are the same.")
                    .containsPattern("AVERAGES  [1-9] same");
        }
    }

    private static void makeTopics(EmbeddedKafka kafka) {
        List<NewTopic> topics = new java.util.ArrayList<>(
                List.of(topic(Topics.REPLAYS, 1), topic(Topics.REPLAYS_STATUS, 1), topic(replay("0000000e"), 1)));
        IDS.forEach(id -> topics.add(topic(replay(id), 2)));
        kafka.createTopics(topics);
    }

    private static NewTopic topic(String name, int partitions) {
        return new NewTopic(name, Optional.of(partitions), Optional.empty());
    }

    private static String replay(String id) {
        return Topics.replay("weeding", id);
    }

    /** @param state null for none told */
    private void addDesired(String id, ReplayStatus.State state) throws Exception {
        ReplayPlan plan = new ReplayPlan(
                null, null, null, false, List.of(), null, ReplayPlan.Stamps.ORIGINAL, null, AnalyticsKind.jobNames());
        DesiredReplay desired = DesiredReplay.started("weeding", replay(id), plan, 1, T0, 1);
        producer.send(new ProducerRecord<>(Topics.REPLAYS, desired.replay(), desired.toBytes()))
                .get();
        if (state != null) {
            byte[] status = new ReplayStatus(1, state, null, true, null).toBytes();
            producer.send(new ProducerRecord<>(Topics.REPLAYS_STATUS, desired.replay(), status))
                    .get();
        }
    }

    /** Two robots in a field of the demonstration farm that come close once, and tell the temperature. */
    private void play(String id) throws Exception {
        for (int second = 0; second < 40; second++) {
            boolean close = second >= 10 && second < 20;
            send(id, 0, second, "event", robot("urn:ngsi-ld:Robot:1", 40.3133, second));
            send(id, 1, second, "event", robot("urn:ngsi-ld:Robot:2", close ? 40.31331 : 40.3135, second));
        }
        send(id, 0, 40, "end", Entity.builder("urn:ngsi-ld:Replay:x", "Replay").build());
        send(id, 1, 40, "end", Entity.builder("urn:ngsi-ld:Replay:x", "Replay").build());
        producer.flush();
    }

    private static Entity robot(String id, double latitude, int second) {
        return Entity.builder(id, "Robot")
                .number("Latitude", latitude)
                .number("Longitude", -3.483)
                .number("Temperature", 20 + second / 10.0)
                .text("Mission", "weeding")
                .build();
    }

    private void send(String id, int partition, int second, String kind, Entity entity) {
        ProducerRecord<String, byte[]> record =
                new ProducerRecord<>(replay(id), partition, T0 + second * 1000L, entity.id(), entity.toBytes());
        Map.of(
                        "ce_id", entity.id() + second,
                        "fiware-service", "farm",
                        "fiware-servicepath", "/",
                        "replay-kind", kind,
                        "replay-epoch", "0",
                        "replay-offset", "0")
                .forEach((name, value) -> record.headers().add(name, value.getBytes(UTF_8)));
        producer.send(record);
    }

    private static String compare(EmbeddedKafka kafka, String a, String b) {
        StringWriter output = new StringWriter();
        CommandLine line = Furrow.commandLine();
        line.setOut(new PrintWriter(output)).setErr(new PrintWriter(output));
        line.execute("replay", "compare", a, b, "--kafka", kafka.bootstrapServers());
        return output.toString();
    }
}
