package io.furrow.control.rest;

import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.TreeMap;
import java.util.concurrent.ExecutionException;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
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

import io.furrow.control.letter.StoredLetter;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.OriginalReference;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@Timeout(120)
class DeadLettersIT {
    @TempDir
    static Path directory;

    /** Not long ago: the broker's retention goes by the record timestamp. */
    private static final long TIME = System.currentTimeMillis() - 60_000;

    @AutoClose
    private static RunningApi running;

    @AutoClose
    private static KafkaProducer<byte[], byte[]> producer;

    @BeforeAll
    static void start() throws Exception {
        running = new RunningApi(directory);
        producer = producer();
    }

    private static final Pattern NEXT = Pattern.compile("<(\\?[^>]+)>; ?rel=\"next\"");

    /** Letters of two topics whose times alternate, between those of other stages. */
    @Tag("full")
    @Test
    void pagesBackThroughAllTopicsWithoutGapsOrDuplicates() throws Exception {
        for (int i = 0; i < 20; i++) {
            send(i % 2 == 0 ? "even.dead" : "odd.dead", TIME + i, new byte[i], "paged", "t-0@" + i);
            send("even.dead", TIME + i, new byte[i], "other", "t-0@" + i);
        }

        List<Integer> sizes = new ArrayList<>();
        List<Integer> pages = new ArrayList<>();
        for (String path = "/api/dead-letters?stage=paged&limit=7"; path != null; ) {
            HttpResponse<byte[]> answer = running.client().send("GET", path, null);
            JsonNode letters = running.client().json(answer);
            letters.forEach(letter -> sizes.add(letter.path("size").asInt()));
            pages.add(letters.size());
            Matcher next = NEXT.matcher(answer.headers().firstValue("Link").orElse(""));
            path = next.matches() ? "/api/dead-letters" + next.group(1) : null;
        }

        assertThat(sizes)
                .containsExactlyElementsOf(
                        IntStream.range(0, 20).mapToObj(i -> 19 - i).toList());
        assertThat(pages).startsWith(7, 7);
        assertThat(list("topic=odd.dead&limit=3"))
                .extracting(letter -> letter.path("size").asInt())
                .containsExactly(19, 17, 15);
        assertThat(list("stage=paged&from=%d&to=%s".formatted(TIME + 4, Instant.ofEpochMilli(TIME + 6))))
                .extracting(letter -> letter.path("size").asInt())
                .containsExactly(5, 4);
        assertThat(list("stage=paged&reason=too-large")).isEmpty();
        running.rejects("GET", "/api/dead-letters?before=noon", null, 400, "wrong-member");
        running.rejects("GET", "/api/dead-letters?topic=nowhere.dead", null, 404, "unknown-topic");
    }

    private static JsonNode list(String query) {
        return ask("GET", "/api/dead-letters?" + query, null);
    }

    @Test
    void showsTheValueAsWhatItIs() throws Exception {
        byte[] large = ("a" + "é".repeat(StoredLetter.MAX_SHOWN_BYTES)).getBytes(UTF_8); // is cut within a character

        JsonNode json = shown("{\"id\":\"r\",\"x\":1.50}".getBytes(UTF_8));
        assertThat(json.path("encoding").asText()).isEqualTo("json");
        assertThat(json.path("value").toString()).isEqualTo("{\"id\":\"r\",\"x\":1.50}");
        assertThat(json.path("cut").asBoolean(true)).isFalse();
        assertThat(json.at("/headers/dead-source").asText()).isEqualTo("t-0@0");
        assertThat(json.path("key").asText()).isEqualTo("k");
        assertThat(shown("{\"half\":".getBytes(UTF_8)).path("value").asText()).isEqualTo("{\"half\":");
        assertThat(shown("\"\\ud800\"".getBytes(UTF_8)).path("value").asText()).isEqualTo("\"\\ud800\"");
        JsonNode binary = shown(new byte[] {(byte) 0xff, 0});
        assertThat(binary.path("encoding").asText()).isEqualTo("base64");
        assertThat(binary.path("value").binaryValue()).containsExactly(0xff, 0);
        JsonNode cut = shown(large);
        assertThat(cut.path("encoding").asText()).isEqualTo("text");
        assertThat(cut.path("cut").asBoolean()).isTrue();
        assertThat(cut.path("size").asInt()).isEqualTo(large.length);
        assertThat(cut.path("value").asText().getBytes(UTF_8)).hasSize(StoredLetter.MAX_SHOWN_BYTES - 1);
        assertThat(shown(null).has("value")).isFalse();

        running.rejects("GET", "/api/dead-letters/shown.dead/0/999", null, 404, "unknown-dead-letter");
        running.rejects("GET", "/api/dead-letters/shown.dead/0/one", null, 404, "unknown-dead-letter");
        running.rejects("GET", "/api/dead-letters/shown/0/0", null, 404, "unknown-topic");
    }

    private static JsonNode shown(byte[] value) {
        send("shown.dead", TIME, value, "test", "t-0@0");
        JsonNode newest = list("topic=shown.dead&limit=1").get(0);
        return ask(
                "GET",
                "/api/dead-letters/shown.dead/%s/%s".formatted(newest.path("partition"), newest.path("offset")),
                null);
    }

    /** A notification sent to a topic of entities becomes a dead letter again. */
    @Test
    void sendsTheLettersOfEachStageToWhereTheyCameFromOrLeavesThem() {
        send("mixed.dead", TIME, new byte[] {1}, "ngsi-source", "192.168.0.7 /ngsi/farm");
        send("mixed.dead", TIME, new byte[] {2}, "ngsi-source", "mixed");
        send("mixed.dead", TIME, new byte[] {3}, "ingest", "mixed-0@7");

        assertThat(redrive("--topic", "mixed.dead"))
                .startsWith("sent 2 dead letters from mixed.dead to mixed: 2 not-json\n"
                        + "left where they are: 1 from notifications to the NGSI source")
                .contains("'to'", "ngsi.notifications");
        assertThat(recordsOf("mixed"))
                .extracting(record -> record.value()[0])
                .containsExactlyInAnyOrder((byte) 2, (byte) 3);
        assertThat(redrive("--topic", "mixed.dead", "--to", "mixed.notifications", "--stage", "ngsi-source"))
                .startsWith("sent 2 ");
        await().untilAsserted(() -> assertThat(ask("GET", "/api/audit?limit=1000", null))
                .filteredOn(entry -> entry.at("/about/to").asText().equals("mixed.notifications"))
                .singleElement()
                .satisfies(entry -> {
                    assertThat(entry.path("command").asText()).isEqualTo("redrive");
                    assertThat(entry.path("result").asText()).isEqualTo("redriven");
                    assertThat(entry.at("/about/topic").asText()).isEqualTo("mixed.dead");
                    assertThat(entry.at("/about/count").asInt()).isEqualTo(2);
                }));
    }

    private static void send(String topic, long time, byte[] value, String stage, String source) {
        deadLetter(topic, time, "k", value, new DeadLetter(Reason.NOT_JSON, "why", stage, source).headers());
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
        assertThat(redrive("--topic", "nowhere.dead")).startsWith("unknown-topic: there is no topic 'nowhere.dead'");
        assertThat(redrive("--topic", "data.raw")).startsWith("unknown-topic: 'data.raw' is no topic of dead letters");
        assertThat(redrive()).startsWith("missing-member: ");
        assertThat(ask("POST", "/api/dead-letters/redrive", "{\"topic\":\"once.dead\",\"to\":\"nowhere\"}")
                        .path("error")
                        .asText())
                .isEqualTo("unknown-topic");
    }

    /** Sends a request, and describes the answer in a sentence. */
    private static String redrive(String... options) {
        ObjectNode body = NgsiJson.object();
        List<String> all = List.of(options);
        for (String member : List.of("topic", "to")) {
            option(all, member).ifPresent(value -> body.put(member, value));
        }
        for (String member : List.of("reason", "stage")) {
            option(all, member)
                    .ifPresent(value -> List.of(value.split(",")).forEach(body.withArray(member + "s")::add));
        }
        if (all.contains("--again")) {
            body.put("again", true);
        }
        option(all, "to").ifPresent(DeadLettersIT::create);
        boolean dry = all.contains("--dry-run");
        JsonNode answer = ask("POST", "/api/dead-letters/redrive" + (dry ? "?dryRun=true" : ""), body.toString());
        if (!answer.has("count")) {
            return answer.path("error").asText() + ": " + answer.path("reason").asText();
        }
        assertThat(answer.path("complete").asBoolean()).isTrue();
        long count = answer.path("count").asLong();
        String reasons = answer.path("reasons").properties().stream()
                .map(each -> each.getValue() + " " + each.getKey())
                .collect(Collectors.joining(", "));
        String left = answer.path("left")
                .valueStream()
                .map(each -> each.path("count") + " " + each.path("why").asText())
                .collect(Collectors.joining(", "));
        return "%s %d dead letter%s from %s to %s%s%s"
                .formatted(
                        answer.path("dryRun").asBoolean() ? "would send" : "sent",
                        count,
                        count == 1 ? "" : "s",
                        answer.path("topic").asText(),
                        answer.path("to").asText(),
                        reasons.isEmpty() ? "" : ": " + reasons,
                        left.isEmpty() ? "" : "\nleft where they are: " + left);
    }

    private static Optional<String> option(List<String> options, String name) {
        int at = options.indexOf("--" + name);
        return at < 0 ? Optional.empty() : Optional.of(options.get(at + 1));
    }

    private static JsonNode ask(String method, String path, String body) {
        try {
            return running.client().ask(method, path, body);
        } catch (Exception e) {
            throw new AssertionError(e);
        }
    }

    /** The broker creates a topic whose partitions are requested. */
    private static void create(String topic) {
        producer.partitionsFor(topic);
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
        deadLetter(topic, TIME, key, value, headers);
    }

    private static void deadLetter(String topic, long time, String key, byte[] value, Map<String, String> headers) {
        byte[] keyBytes = key == null ? null : key.getBytes(UTF_8);
        ProducerRecord<byte[], byte[]> record = new ProducerRecord<>(topic, null, time, keyBytes, value);
        headers.forEach((name, text) -> record.headers().add(name, text.getBytes(UTF_8)));
        try {
            Topics.ofDeadLetters(topic).ifPresent(producer::partitionsFor);
            producer.send(record).get();
        } catch (InterruptedException | ExecutionException e) {
            throw new AssertionError(e);
        }
    }

    private static KafkaProducer<byte[], byte[]> producer() {
        Properties settings = new Properties();
        settings.putAll(running.settings().client());
        settings.put("max.request.size", 4_000_000);
        return new KafkaProducer<>(settings, new ByteArraySerializer(), new ByteArraySerializer());
    }

    /** Also those whose transaction is committed, though its marker may still be on the way. */
    private static List<ConsumerRecord<byte[], byte[]>> recordsOf(String topic) {
        Properties settings = new Properties();
        settings.putAll(running.settings().client());
        settings.put("auto.offset.reset", "earliest");
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
