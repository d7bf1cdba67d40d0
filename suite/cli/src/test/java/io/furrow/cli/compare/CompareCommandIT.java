package io.furrow.cli.compare;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.Optional;

import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;

import io.furrow.cli.Commands;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.model.ngsi.Entity;

import static io.furrow.cli.compare.ResultRecords.encounter;
import static io.furrow.cli.compare.ResultRecords.entered;
import static io.furrow.cli.compare.ResultRecords.left;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

@Tag("full")
class CompareCommandIT {
    private static final String A = "data.weeding.replay.0000000a";
    private static final String B = "data.weeding.replay.0000000b";

    @TempDir
    static Path folder;

    @AutoClose
    private static EmbeddedKafka kafka;

    @BeforeAll
    static void playsTwoReplays() throws Exception {
        kafka = EmbeddedKafka.start(folder.resolve("kafka"), 0);
        kafka.createTopics(List.of(A, A + ".collision", A + ".presence", B, B + ".collision", "data.collision").stream()
                .map(topic -> new NewTopic(topic, Optional.of(2), Optional.empty()))
                .toList());

        try (KafkaProducer<byte[], byte[]> producer = new KafkaProducer<>(
                Map.of("bootstrap.servers", kafka.bootstrapServers(), "transactional.id", "test"),
                new ByteArraySerializer(),
                new ByteArraySerializer())) {
            producer.initTransactions();
            producer.beginTransaction();
            send(producer, A + ".collision", 0, encounter("xy", "ended", 2, 0, 10));
            send(producer, A + ".collision", 1, encounter("xy", "ended", 2, 5, 10));
            send(producer, A + ".presence", 0, left("x", "f", 0, 10));
            send(producer, A, 0, entered("x", "f", 0));
            send(producer, A, 2, entered("x", "f", 0));
            send(producer, B, 0, entered("x", "f", 0));
            send(producer, B + ".collision", 0, encounter("xy", "ended", 2, 0, 10));
            send(producer, "data.collision", null, encounter("xy", "ended", 2, 0, 10));
            producer.commitTransaction();
            producer.beginTransaction();
            send(producer, B + ".collision", 0, encounter("zz", "ended", 2, 0, 10));
            producer.flush();
            producer.abortTransaction();
        }
    }

    private static void send(KafkaProducer<byte[], byte[]> producer, String topic, Integer epoch, Entity entity) {
        ProducerRecord<byte[], byte[]> record = new ProducerRecord<>(topic, entity.toBytes());
        if (epoch != null) {
            record.headers().add("replay-epoch", epoch.toString().getBytes(UTF_8));
        }
        producer.send(record);
    }

    @Test
    void comparesTheNewestEpochsOrThoseThatAreNamed() {
        StringWriter output = new StringWriter();

        // In epoch 2 of A nothing was found.
        assertThat(run(output, "weeding.0000000a", "weeding.0000000b")).isEqualTo(1);
        assertThat(output.toString())
                .contains("A  weeding.0000000a, epoch 2", "ENCOUNTERS  0 same, 0 changed, 0 only in A, 1 only in B")
                .contains("no topic of averages, stays: nothing was found, or the job did not run")
                .contains("AVERAGES  none on either side");

        assertThat(run(output, "weeding.0000000a", B, "--epoch-a", "1")).isEqualTo(1);
        assertThat(output.toString()).contains("1 changed, 0 only in A, 0 only in B", "start 5 s earlier");
    }

    @Test
    void comparesAReplayWithWhatWasFoundLive() throws Exception {
        StringWriter output = new StringWriter();
        Path html = folder.resolve("picture.html");

        assertThat(run(
                        output,
                        "weeding.0000000b",
                        "live",
                        "--from",
                        "2026-05-01T01:40:00Z",
                        "--to",
                        "1777700000000",
                        "--html",
                        html.toString()))
                .isZero();

        assertThat(output.toString()).contains("1 same", "A and B are the same.");
        assertThat(run(output, "weeding.0000000b", "live", "--from", "2026-05-01", "--to", "2026-05-02", "-o", "yaml"))
                .isZero();
        assertThat(output.toString()).contains("same: true\na:\n  name: \"weeding.0000000b\"\n");
        assertThat(Files.readString(html)).startsWith("<!doctype html>").doesNotContain("{{");
    }

    @Test
    void reportsWhatCannotBeCompared() {
        StringWriter output = new StringWriter();

        assertThat(run(output, "weeding.0000000a", "live")).isEqualTo(2);
        assertThat(run(output, "weeding.0000000b", "live", "--from", "-5m")).isEqualTo(2);
        assertThat(run(output, "weeding.0000000a", "weeding.0000000a")).isEqualTo(2);
        assertThat(run(output, "weeding.0000000a", "weeding.0000000c")).isEqualTo(2);
        assertThat(run(output, "weeding.0000000b", "live", "--from", "2026-04-01T00:00:00Z", "--to", "1777000000000"))
                .isEqualTo(2);
        assertThat(output.toString())
                .contains(
                        "live goes on all the time: say since when with --from",
                        "A and B are the same; name two",
                        "There is no topic",
                        "Nothing was compared: neither weeding.0000000b nor live has a result there.");
        assertThat(output.toString().split("Nothing was compared")).hasSize(3);
    }

    private static int run(StringWriter output, String... args) {
        CommandLine line = Commands.commandLine(CommandSpec.create().name("furrow"), Commands.ALL);
        line.setOut(new PrintWriter(output)).setErr(new PrintWriter(output));
        String[] all = java.util.stream.Stream.of(
                        List.of("replay", "compare"), List.of(args), List.of("--kafka", kafka.bootstrapServers()))
                .flatMap(List::stream)
                .toArray(String[]::new);
        return line.execute(all);
    }
}
