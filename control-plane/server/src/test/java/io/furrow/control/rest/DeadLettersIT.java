package io.furrow.control.rest;

import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.control.letter.StoredRecord;

import static io.furrow.control.rest.DeadLetterTopics.TIME;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

@Tag("full")
@Timeout(120)
class DeadLettersIT {
    @TempDir
    static Path directory;

    @AutoClose
    private static RunningApi running;

    @AutoClose
    private static DeadLetterTopics topics;

    @BeforeAll
    static void start() throws Exception {
        running = new RunningApi(directory);
        topics = new DeadLetterTopics(running.settings().client());
    }

    private static final Pattern NEXT = Pattern.compile("<(\\?[^>]+)>; ?rel=\"next\"");

    /** Letters of two topics whose times alternate, between those of other stages. */
    @Test
    void pagesBackThroughAllTopicsWithoutGapsOrDuplicates() throws Exception {
        for (int i = 0; i < 20; i++) {
            topics.send(i % 2 == 0 ? "even.dead" : "odd.dead", TIME + i, new byte[i], "paged", "t-0@" + i);
            topics.send("even.dead", TIME + i, new byte[i], "other", "t-0@" + i);
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
        byte[] large = ("a" + "é".repeat(StoredRecord.MAX_SHOWN_BYTES)).getBytes(UTF_8); // is cut within a character

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
        assertThat(cut.path("value").asText().getBytes(UTF_8)).hasSize(StoredRecord.MAX_SHOWN_BYTES - 1);
        assertThat(shown(null).has("value")).isFalse();

        running.rejects("GET", "/api/dead-letters/shown.dead/0/999", null, 404, "unknown-dead-letter");
        running.rejects("GET", "/api/dead-letters/shown.dead/0/one", null, 404, "unknown-dead-letter");
        running.rejects("GET", "/api/dead-letters/shown/0/0", null, 404, "unknown-topic");
    }

    /** Another topic's records are no part of it, and large values end a page early. */
    @Test
    void listsAndShowsRecordsOfATopic() throws Exception {
        for (int i = 0; i < 9; i++) {
            byte[] value = "{\"id\":\"r-%d\",\"fill\":\"%s\"}"
                    .formatted(i, "x".repeat(90_000))
                    .getBytes(UTF_8);
            topics.deadLetter("data.read", TIME + i, i % 2 == 0 ? "even" : "odd", value, Map.of("service", "farm"));
        }

        assertThat(read("limit=4")).containsExactly(8L, 7L, 6L, 5L);
        assertThat(read("key=odd")).containsExactly(7L, 5L, 3L, 1L);
        assertThat(read("text=r-3")).containsExactly(3L);
        assertThat(read("from=%d&to=%s".formatted(TIME + 4, Instant.ofEpochMilli(TIME + 6))))
                .containsExactly(5L, 4L);
        HttpResponse<byte[]> page =
                running.client().send("GET", "/api/topics/data.read/records?key=even&limit=2", null);
        Matcher next = NEXT.matcher(page.headers().firstValue("Link").orElse(""));
        assertThat(next.matches()).isTrue();
        assertThat(ask("GET", "/api/topics/data.read/records" + next.group(1), null))
                .extracting(record -> record.path("time").asLong() - TIME)
                .containsExactly(4L, 2L);

        JsonNode whole = ask("GET", "/api/topics/data.read/records?values=true&limit=1", null)
                .get(0);
        assertThat(whole.at("/headers/service").asText()).isEqualTo("farm");
        assertThat(whole.path("cut").asBoolean()).isTrue();
        assertThat(whole.path("value").asText()).startsWith("{\"id\":\"r-8\"").hasSize(StoredRecord.MAX_SHOWN_BYTES);
        assertThat(whole)
                .isEqualTo(ask(
                        "GET",
                        "/api/topics/data.read/records/%s/%s".formatted(whole.path("partition"), whole.path("offset")),
                        null));
        assertThat(ask("GET", "/api/topics/data.read/records?limit=1", null)
                        .get(0)
                        .has("value"))
                .isFalse();
        assertThat(ask("GET", "/api/topics", null).toString())
                .containsPattern("\"topic\":\"data.read\",\"partitions\":[0-9]+,\"records\":9[^0-9]");
        running.rejects("GET", "/api/topics/data.read/records?values=true&limit=1001", null, 400, "wrong-member");
        running.rejects("GET", "/api/topics/data.read/records?before=noon", null, 400, "wrong-member");
        running.rejects("GET", "/api/topics/data.read/records/0/999", null, 404, "unknown-record");
        for (String topic : List.of("shown.dead", "__consumer_offsets", "data.nosuch")) {
            running.rejects("GET", "/api/topics/" + topic + "/records", null, 404, "unknown-topic");
        }
    }

    @Test
    void endsAPageOfLargeValuesAndContinues() throws Exception {
        for (int i = 0; i < 80; i++) {
            topics.deadLetter("data.large", TIME, "k", new byte[70_000], Map.of());
        }
        endsAPageAfter("data.large", (4 << 20) / StoredRecord.MAX_SHOWN_BYTES, 80);
    }

    @Test
    void endsAPageOfManyHeadersAndContinues() throws Exception {
        Map<String, String> headers = IntStream.range(100, 200)
                .boxed()
                .collect(Collectors.toMap(i -> "%d".formatted(i), i -> "x".repeat(497)));
        for (int i = 0; i < 90; i++) {
            topics.deadLetter("data.headers", TIME, "k", new byte[0], headers);
        }
        endsAPageAfter("data.headers", (4 << 20) / 50_000 + 1, 90);
    }

    private static void endsAPageAfter(String topic, int first, int all) throws Exception {
        String records = "/api/topics/" + topic + "/records";
        HttpResponse<byte[]> page = running.client().send("GET", records + "?values=true&limit=1000", null);

        assertThat(running.client().json(page)).hasSize(first);
        Matcher next = NEXT.matcher(page.headers().firstValue("Link").orElse(""));
        assertThat(next.matches()).isTrue();
        assertThat(ask("GET", records + next.group(1), null)).hasSize(all - first);
    }

    private static List<Long> read(String query) {
        return ask("GET", "/api/topics/data.read/records?" + query, null)
                .valueStream()
                .map(record -> record.path("time").asLong() - TIME)
                .toList();
    }

    private static JsonNode shown(byte[] value) {
        topics.send("shown.dead", TIME, value, "test", "t-0@0");
        JsonNode newest = list("topic=shown.dead&limit=1").get(0);
        return ask(
                "GET",
                "/api/dead-letters/shown.dead/%s/%s".formatted(newest.path("partition"), newest.path("offset")),
                null);
    }

    private static JsonNode ask(String method, String path, String body) {
        try {
            return running.client().ask(method, path, body);
        } catch (Exception e) {
            throw new AssertionError(e);
        }
    }
}
