package io.furrow.launcher;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.Reason;

import static org.assertj.core.api.Assertions.assertThat;

@Timeout(120)
class DeadLettersIT {
    @TempDir
    static Path directory;

    private static EmbeddedKafka kafka;

    @BeforeAll
    static void start() {
        kafka = EmbeddedKafka.start(directory);
    }

    @AfterAll
    static void stop() {
        kafka.close();
    }

    @Test
    void bringsEachLetterBackOnceAsItWas() {
        byte[] original = {'{', (byte) 0xff};
        letter("once.dead", "robot", original, Reason.NOT_JSON, "cut off", Map.of("trace", "7"));
        letter("once.dead", null, null, Reason.NOT_AN_EVENT, "empty", Map.of());

        assertThat(refeed("--topic", "once.dead"))
                .isEqualTo("brought 2 dead letters from once.dead to once: 1 not-an-event, 1 not-json");
        assertThat(refeed("--topic", "once.dead")).isEqualTo("brought 0 dead letters from once.dead to once");

        List<ConsumerRecord<byte[], byte[]>> back = recordsOf("once");
        assertThat(back).hasSize(2);
        assertThat(back)
                .filteredOn(record -> record.key() != null)
                .singleElement()
                .satisfies(record -> {
                    assertThat(record.value()).isEqualTo(original);
                    assertThat(record.timestamp()).isEqualTo(1_700_000_000_000L);
                    assertThat(headers(record)).isEqualTo(Map.of("trace", "7"));
                });
        assertThat(back)
                .filteredOn(record -> record.key() == null)
                .singleElement()
                .satisfies(record -> assertThat(record.value()).isNull());
    }

    @Test
    void countsThemOnlyInADryRun() {
        letter("dry.dead", "k", new byte[] {1}, Reason.NOT_JSON, "why", Map.of());

        assertThat(refeed("--topic", "dry.dead", "--dry-run"))
                .isEqualTo("would bring 1 dead letters from dry.dead to dry: 1 not-json");
        assertThat(refeed("--topic", "dry.dead"))
                .as("nothing was remembered as done")
                .startsWith("brought 1 ");
    }

    @Test
    void leavesWhatWasNotAskedForOrIsNoLongerWhole() {
        letter("some.dead", "k", new byte[] {1}, Reason.NOT_JSON, "why", Map.of());
        letter("some.dead", "k", new byte[] {2}, Reason.NOT_AN_ENTITY, "why", Map.of());
        letter("some.dead", "k", new byte[] {3}, Reason.NOT_JSON, "why (truncated to 1 bytes)", Map.of());

        assertThat(refeed("--topic", "some.dead", "--to", "elsewhere", "--reason", "not-json"))
                .isEqualTo("brought 1 dead letters from some.dead to elsewhere: 1 not-json\n"
                        + "left where they are: 1 not-an-entity, 1 truncated");
        assertThat(recordsOf("elsewhere")).extracting(ConsumerRecord::value).containsExactly(new byte[] {1});
    }

    @Test
    void bringsThemAgainWhereAskedTo() {
        letter("again.dead", "k", new byte[] {1}, Reason.NOT_JSON, "why", Map.of());
        refeed("--topic", "again.dead");

        assertThat(refeed("--topic", "again.dead", "--again")).startsWith("brought 1 ");
        assertThat(recordsOf("again")).hasSize(2);
    }

    @Test
    void saysWhatIsMissing() {
        assertThat(refeed("--topic", "nowhere.dead")).contains("there is no topic nowhere.dead");
        assertThat(refeed("--topic", "data.raw")).contains("--to");
    }

    private static String refeed(String... options) {
        List<String> words = new ArrayList<>(List.of("dead-letters", "refeed", "--kafka", kafka.bootstrapServers()));
        words.addAll(List.of(options));
        StringWriter said = new StringWriter();
        PrintWriter printer = new PrintWriter(said, true);
        Furrow.commandLine().setOut(printer).setErr(printer).execute(words.toArray(String[]::new));
        return said.toString().strip();
    }

    private static void letter(
            String topic, String key, byte[] value, Reason reason, String message, Map<String, String> own) {
        Map<String, String> headers = new TreeMap<>(own);
        headers.putAll(new DeadLetter(reason, message, "test", "t-0@0").headers());
        byte[] keyBytes = key == null ? null : key.getBytes(StandardCharsets.UTF_8);
        ProducerRecord<byte[], byte[]> record = new ProducerRecord<>(topic, null, 1_700_000_000_000L, keyBytes, value);
        headers.forEach((name, text) -> record.headers().add(name, text.getBytes(StandardCharsets.UTF_8)));
        Map<String, Object> settings = Map.of("bootstrap.servers", kafka.bootstrapServers());
        try (var producer = new KafkaProducer<>(settings, new ByteArraySerializer(), new ByteArraySerializer())) {
            producer.send(record);
        }
    }

    private static List<ConsumerRecord<byte[], byte[]>> recordsOf(String topic) {
        Map<String, Object> settings = Map.of(
                "bootstrap.servers", kafka.bootstrapServers(),
                "auto.offset.reset", "earliest",
                "isolation.level", "read_committed");
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
        record.headers()
                .forEach(header -> headers.put(header.key(), new String(header.value(), StandardCharsets.UTF_8)));
        return headers;
    }
}
