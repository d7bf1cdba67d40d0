package io.furrow.cli;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.concurrent.ExecutionException;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine.Model.CommandSpec;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.OriginalReference;
import io.furrow.model.ngsi.Reason;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

@Timeout(120)
class DeadLettersIT {
    @TempDir
    static Path directory;

    /** Not long ago: the broker's retention goes by the record timestamp. */
    private static final long TIME = System.currentTimeMillis() - 60_000;

    @AutoClose
    private static EmbeddedKafka kafka;

    @BeforeAll
    static void start() {
        kafka = EmbeddedKafka.start(directory);
    }

    @Test
    void bringsEachLetterBackOnceAsItWas() {
        byte[] original = {'{', (byte) 0xff};
        deadLetter("once.dead", "robot", original, Reason.NOT_JSON, "cut off", Map.of("trace", "7"));
        deadLetter("once.dead", null, null, Reason.NOT_AN_EVENT, "empty", Map.of());

        assertThat(redrive("--topic", "once.dead"))
                .isEqualTo("sent 2 dead letters from once.dead to once: 1 not-an-event, 1 not-json");
        assertThat(redrive("--topic", "once.dead")).isEqualTo("sent 0 dead letters from once.dead to once");

        List<ConsumerRecord<byte[], byte[]>> back = recordsOf("once");
        assertThat(back).hasSize(2);
        assertThat(back)
                .filteredOn(record -> record.key() != null)
                .singleElement()
                .satisfies(record -> {
                    assertThat(record.value()).isEqualTo(original);
                    assertThat(record.timestamp()).isEqualTo(TIME);
                    assertThat(headers(record)).isEqualTo(Map.of("trace", "7"));
                });
        assertThat(back)
                .filteredOn(record -> record.key() == null)
                .singleElement()
                .satisfies(record -> assertThat(record.value()).isNull());
    }

    @Tag("full")
    @Test
    void countsThemOnlyInADryRun() {
        deadLetter("dry.dead", "k", new byte[] {1}, Reason.NOT_JSON, "why", Map.of());

        assertThat(redrive("--topic", "dry.dead", "--dry-run"))
                .isEqualTo("would send 1 dead letter from dry.dead to dry: 1 not-json");
        assertThat(redrive("--topic", "dry.dead"))
                .as("nothing was remembered as done")
                .startsWith("sent 1 ");
    }

    @Tag("full")
    @Test
    void leavesWhatWasNotRequestedOrIsNoLongerWhole() {
        deadLetter("some.dead", "k", new byte[] {1}, Reason.NOT_JSON, "why", Map.of());
        deadLetter("some.dead", "k", new byte[] {2}, Reason.NOT_AN_ENTITY, "why", Map.of());
        deadLetter("some.dead", "k", new byte[] {3}, Reason.NOT_JSON, "why (truncated to 1 bytes)", Map.of());

        assertThat(redrive("--topic", "some.dead", "--to", "elsewhere", "--reason", "not-json"))
                .isEqualTo("sent 1 dead letter from some.dead to elsewhere: 1 not-json\n"
                        + "left where they are: 1 not-an-entity of test, 1 truncated");
        assertThat(recordsOf("elsewhere")).extracting(ConsumerRecord::value).containsExactly(new byte[] {1});
    }

    /** The last one is the first to be brought: what was left before it is not taken for brought. */
    @Tag("full")
    @Test
    void reportsAgainWhatItLeftBeforeALetterThatItBrought() {
        deadLetter("left.dead", "k", new byte[] {1}, Reason.NOT_JSON, "why (truncated to 1 bytes)", Map.of());
        deadLetter("left.dead", "k", new byte[] {2}, Reason.NOT_JSON, "why", Map.of());

        assertThat(redrive("--topic", "left.dead"))
                .isEqualTo("sent 1 dead letter from left.dead to left: 1 not-json\nleft where they are: 1 truncated");
        assertThat(redrive("--topic", "left.dead"))
                .isEqualTo("sent 0 dead letters from left.dead to left\nleft where they are: 1 truncated");
    }

    @Tag("full")
    @Test
    void bringsThemAgainWhereConfigured() {
        deadLetter("again.dead", "k", new byte[] {1}, Reason.NOT_JSON, "why", Map.of());
        redrive("--topic", "again.dead");

        assertThat(redrive("--topic", "again.dead", "--again")).startsWith("sent 1 ");
        assertThat(recordsOf("again")).hasSize(2);
    }

    @Tag("full")
    @Test
    void bringsEachBackOnceWhicheverReasonsAreRequestedTogether() {
        deadLetter("kinds.dead", "a", new byte[] {1}, Reason.NOT_JSON, "why", Map.of());
        deadLetter("kinds.dead", "b", new byte[] {2}, Reason.TOO_LARGE, "why", Map.of());
        deadLetter("kinds.dead", "c", new byte[] {3}, Reason.NOT_AN_ENTITY, "why", Map.of());

        assertThat(redrive("--topic", "kinds.dead", "--reason", "not-json")).startsWith("sent 1 ");
        assertThat(redrive("--topic", "kinds.dead", "--reason", "too-large,not-json"))
                .contains("sent 1 dead letter from kinds.dead to kinds: 1 too-large");
        deadLetter("kinds.dead", "d", new byte[] {4}, Reason.NOT_JSON, "why", Map.of());
        assertThat(redrive("--topic", "kinds.dead"))
                .isEqualTo("sent 2 dead letters from kinds.dead to kinds: 1 not-an-entity, 1 not-json");
        assertThat(redrive("--topic", "kinds.dead", "--reason", "not-json")).startsWith("sent 0 ");

        assertThat(recordsOf("kinds"))
                .extracting(record -> record.value()[0])
                .containsExactlyInAnyOrder((byte) 1, (byte) 2, (byte) 3, (byte) 4);
    }

    @Tag("full")
    @Test
    void remembersEachTargetByItself() {
        deadLetter("two.dead", "k", new byte[] {1}, Reason.NOT_JSON, "why", Map.of());

        assertThat(redrive("--topic", "two.dead", "--to", "first")).startsWith("sent 1 ");
        assertThat(redrive("--topic", "two.dead", "--to", "second")).startsWith("sent 1 ");
        assertThat(redrive("--topic", "two.dead", "--to", "first")).startsWith("sent 0 ");
    }

    @Tag("full")
    @Test
    void leavesLettersWhoseEventWentOnUnlessTheirStageIsNamed() {
        deadLetterOf("ingest-images", "went.dead", 1, Reason.NOT_AN_IMAGE);
        deadLetterOf("missions", "went.dead", 2, Reason.REFUSED);
        deadLetterOf("ingest", "went.dead", 3, Reason.NOT_JSON);

        assertThat(redrive("--topic", "went.dead"))
                .isEqualTo("sent 1 dead letter from went.dead to went: 1 not-json\n"
                        + "left where they are: 1 not-an-image of ingest-images, whose event went on, "
                        + "1 refused of missions, whose event went on");
        assertThat(redrive("--topic", "went.dead", "--reason", "not-an-image"))
                .as("a reason is not a stage")
                .startsWith("sent 0 ");
        assertThat(redrive("--topic", "went.dead", "--stage", "missions")).contains(": 1 refused\n");
        assertThat(recordsOf("went")).extracting(record -> record.value()[0]).containsExactly((byte) 3, (byte) 2);
    }

    @Tag("full")
    @Test
    void bringsBackTheWholeOfWhatALetterStandsFor() {
        byte[] whole = new byte[2_000_000];
        whole[whole.length - 1] = 7;
        deadLetter("large", "other", new byte[] {1}, Map.of());
        OriginalReference place = place("large", "robot", whole, Map.of("trace", "7"));
        standIn("large.dead", "robot", place);
        standIn("large.dead", "another", place);
        standIn("large.dead", "robot", new OriginalReference("large", place.partition(), 99, 2_000_000));
        standIn("large.dead", "robot", new OriginalReference("nowhere", 0, 0, 2_000_000));

        assertThat(redrive("--topic", "large.dead", "--to", "whole"))
                .isEqualTo("sent 1 dead letter from large.dead to whole: 1 not-json\n"
                        + "left where they are: 3 original gone");
        assertThat(recordsOf("whole")).singleElement().satisfies(record -> {
            assertThat(record.value()).isEqualTo(whole);
            assertThat(record.timestamp()).isEqualTo(TIME);
            assertThat(headers(record)).isEqualTo(Map.of("trace", "7"));
        });
    }

    @Tag("full")
    @Test
    void reportsWhatIsMissing() {
        assertThat(redrive("--topic", "nowhere.dead")).contains("there is no topic nowhere.dead");
        assertThat(redrive("--topic", "data.raw")).contains("--to");
    }

    private static String redrive(String... options) {
        List<String> arguments =
                new ArrayList<>(List.of("dead-letters", "redrive", "--kafka", kafka.bootstrapServers()));
        arguments.addAll(List.of(options));
        StringWriter output = new StringWriter();
        PrintWriter printer = new PrintWriter(output, true);
        Commands.commandLine(CommandSpec.create().name("furrow"), Commands.ALL)
                .setOut(printer)
                .setErr(printer)
                .execute(arguments.toArray(String[]::new));
        return output.toString().strip();
    }

    /** Where the record is afterwards. */
    private static OriginalReference place(String topic, String key, byte[] value, Map<String, String> headers) {
        deadLetter(topic, key, value, headers);
        return recordsOf(topic).stream()
                .filter(record -> Arrays.equals(record.value(), value))
                .map(record -> new OriginalReference(topic, record.partition(), record.offset(), value.length))
                .findFirst()
                .orElseThrow();
    }

    private static void standIn(String topic, String key, OriginalReference original) {
        deadLetter(topic, key, new byte[] {0}, Reason.NOT_JSON, "why", original.headers());
    }

    private static void deadLetterOf(String stage, String topic, int value, Reason reason) {
        deadLetter(topic, "k", new byte[] {(byte) value}, new DeadLetter(reason, "why", stage, "t-0@0").headers());
    }

    private static void deadLetter(
            String topic, String key, byte[] value, Reason reason, String message, Map<String, String> own) {
        Map<String, String> headers = new TreeMap<>(own);
        headers.putAll(new DeadLetter(reason, message, "test", "t-0@0").headers());
        deadLetter(topic, key, value, headers);
    }

    private static void deadLetter(String topic, String key, byte[] value, Map<String, String> headers) {
        byte[] keyBytes = key == null ? null : key.getBytes(UTF_8);
        ProducerRecord<byte[], byte[]> record = new ProducerRecord<>(topic, null, TIME, keyBytes, value);
        headers.forEach((name, text) -> record.headers().add(name, text.getBytes(UTF_8)));
        Map<String, Object> settings =
                Map.of("bootstrap.servers", kafka.bootstrapServers(), "max.request.size", 4_000_000);
        try (var producer = new KafkaProducer<>(settings, new ByteArraySerializer(), new ByteArraySerializer())) {
            producer.send(record).get();
        } catch (InterruptedException | ExecutionException e) {
            throw new AssertionError(e);
        }
    }

    /** Also those whose transaction is committed, though its marker may still be on the way. */
    private static List<ConsumerRecord<byte[], byte[]>> recordsOf(String topic) {
        Map<String, Object> settings =
                Map.of("bootstrap.servers", kafka.bootstrapServers(), "auto.offset.reset", "earliest");
        List<ConsumerRecord<byte[], byte[]>> records = new ArrayList<>();
        try (var consumer = new KafkaConsumer<>(settings, new ByteArrayDeserializer(), new ByteArrayDeserializer())) {
            consumer.assign(consumer.partitionsFor(topic).stream()
                    .map(partition -> new TopicPartition(topic, partition.partition()))
                    .toList());
            Map<TopicPartition, Long> ends = consumer.endOffsets(consumer.assignment());
            while (ends.entrySet().stream().anyMatch(end -> consumer.position(end.getKey()) < end.getValue())) {
                consumer.poll(Duration.ofMillis(100)).forEach(records::add);
            }
        }
        return records;
    }

    private static Map<String, String> headers(ConsumerRecord<byte[], byte[]> record) {
        Map<String, String> headers = new TreeMap<>();
        record.headers().forEach(header -> headers.put(header.key(), new String(header.value(), UTF_8)));
        return headers;
    }
}
