package io.furrow.control.rest;

import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.stream.Collectors;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.model.event.OriginalReference;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;

import static io.furrow.control.rest.DeadLetterTopics.TIME;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@Timeout(120)
class RedriveIT {
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

    /** A notification sent to a topic of entities becomes a dead letter again. */
    @Test
    void sendsTheLettersOfEachStageToWhereTheyCameFromOrLeavesThem() {
        topics.send("mixed.dead", TIME, new byte[] {1}, "ngsi-source", "192.168.0.7 /ngsi/farm");
        topics.send("mixed.dead", TIME, new byte[] {2}, "ngsi-source", "mixed");
        topics.send("mixed.dead", TIME, new byte[] {3}, "ingest", "mixed-0@7");

        assertThat(redrive("--topic", "mixed.dead"))
                .startsWith("sent 2 dead letters from mixed.dead to mixed: 2 not-json\n"
                        + "left where they are: 1 from notifications to the NGSI source")
                .contains("'to'", "ngsi.notifications");
        assertThat(topics.recordsOf("mixed"))
                .extracting(record -> record.value()[0])
                .containsExactlyInAnyOrder((byte) 2, (byte) 3);
        assertThat(redrive("--topic", "mixed.dead", "--to", "ngsi.mixed", "--stage", "ngsi-source"))
                .startsWith("sent 2 ");
        await().untilAsserted(() -> assertThat(ask("GET", "/api/audit?limit=1000", null))
                .filteredOn(entry -> entry.at("/about/to").asText().equals("ngsi.mixed"))
                .singleElement()
                .satisfies(entry -> {
                    assertThat(entry.path("command").asText()).isEqualTo("redrive");
                    assertThat(entry.path("result").asText()).isEqualTo("redriven");
                    assertThat(entry.at("/about/topic").asText()).isEqualTo("mixed.dead");
                    assertThat(entry.at("/about/count").asInt()).isEqualTo(2);
                }));
    }

    @Test
    void bringsEachLetterBackOnceAsItWas() {
        byte[] original = {'{', (byte) 0xff};
        topics.deadLetter("once.dead", "robot", original, Reason.NOT_JSON, "cut off", Map.of("trace", "7"));
        topics.deadLetter("once.dead", null, null, Reason.NOT_AN_EVENT, "empty", Map.of());

        assertThat(redrive("--topic", "once.dead"))
                .isEqualTo("sent 2 dead letters from once.dead to once: 1 not-an-event, 1 not-json");
        assertThat(redrive("--topic", "once.dead")).isEqualTo("sent 0 dead letters from once.dead to once");

        List<ConsumerRecord<byte[], byte[]>> back = topics.recordsOf("once");
        assertThat(back).hasSize(2);
        assertThat(back)
                .filteredOn(record -> record.key() != null)
                .singleElement()
                .satisfies(record -> {
                    assertThat(record.value()).isEqualTo(original);
                    assertThat(record.timestamp()).isEqualTo(TIME);
                    assertThat(DeadLetterTopics.headers(record)).isEqualTo(Map.of("trace", "7"));
                });
        assertThat(back)
                .filteredOn(record -> record.key() == null)
                .singleElement()
                .satisfies(record -> assertThat(record.value()).isNull());
    }

    @Tag("full")
    @Test
    void countsThemOnlyInADryRun() {
        topics.deadLetter("dry.dead", "k", new byte[] {1}, Reason.NOT_JSON, "why", Map.of());

        assertThat(redrive("--topic", "dry.dead", "--dry-run"))
                .isEqualTo("would send 1 dead letter from dry.dead to dry: 1 not-json");
        assertThat(redrive("--topic", "dry.dead"))
                .as("nothing was remembered as done")
                .startsWith("sent 1 ");
    }

    @Tag("full")
    @Test
    void leavesWhatWasNotRequestedOrIsNoLongerWhole() {
        topics.deadLetter("some.dead", "k", new byte[] {1}, Reason.NOT_JSON, "why", Map.of());
        topics.deadLetter("some.dead", "k", new byte[] {2}, Reason.NOT_AN_ENTITY, "why", Map.of());
        topics.deadLetter("some.dead", "k", new byte[] {3}, Reason.NOT_JSON, "why (truncated to 1 bytes)", Map.of());

        assertThat(redrive("--topic", "some.dead", "--to", "data.elsewhere", "--reason", "not-json"))
                .isEqualTo("sent 1 dead letter from some.dead to data.elsewhere: 1 not-json\n"
                        + "left where they are: 1 not-an-entity of test, 1 truncated");
        assertThat(topics.recordsOf("data.elsewhere"))
                .extracting(ConsumerRecord::value)
                .containsExactly(new byte[] {1});
    }

    /** The last one is the first to be brought: what was left before it is not taken for brought. */
    @Tag("full")
    @Test
    void reportsAgainWhatItLeftBeforeALetterThatItBrought() {
        topics.deadLetter("left.dead", "k", new byte[] {1}, Reason.NOT_JSON, "why (truncated to 1 bytes)", Map.of());
        topics.deadLetter("left.dead", "k", new byte[] {2}, Reason.NOT_JSON, "why", Map.of());

        assertThat(redrive("--topic", "left.dead"))
                .isEqualTo("sent 1 dead letter from left.dead to left: 1 not-json\nleft where they are: 1 truncated");
        assertThat(redrive("--topic", "left.dead"))
                .isEqualTo("sent 0 dead letters from left.dead to left\nleft where they are: 1 truncated");
    }

    @Tag("full")
    @Test
    void bringsThemAgainWhereConfigured() {
        topics.deadLetter("again.dead", "k", new byte[] {1}, Reason.NOT_JSON, "why", Map.of());
        redrive("--topic", "again.dead");

        assertThat(redrive("--topic", "again.dead", "--again")).startsWith("sent 1 ");
        assertThat(topics.recordsOf("again")).hasSize(2);
    }

    @Tag("full")
    @Test
    void bringsEachBackOnceWhicheverReasonsAreRequestedTogether() {
        topics.deadLetter("kinds.dead", "a", new byte[] {1}, Reason.NOT_JSON, "why", Map.of());
        topics.deadLetter("kinds.dead", "b", new byte[] {2}, Reason.TOO_LARGE, "why", Map.of());
        topics.deadLetter("kinds.dead", "c", new byte[] {3}, Reason.NOT_AN_ENTITY, "why", Map.of());

        assertThat(redrive("--topic", "kinds.dead", "--reason", "not-json")).startsWith("sent 1 ");
        assertThat(redrive("--topic", "kinds.dead", "--reason", "too-large,not-json"))
                .contains("sent 1 dead letter from kinds.dead to kinds: 1 too-large");
        topics.deadLetter("kinds.dead", "d", new byte[] {4}, Reason.NOT_JSON, "why", Map.of());
        assertThat(redrive("--topic", "kinds.dead"))
                .isEqualTo("sent 2 dead letters from kinds.dead to kinds: 1 not-an-entity, 1 not-json");
        assertThat(redrive("--topic", "kinds.dead", "--reason", "not-json")).startsWith("sent 0 ");

        assertThat(topics.recordsOf("kinds"))
                .extracting(record -> record.value()[0])
                .containsExactlyInAnyOrder((byte) 1, (byte) 2, (byte) 3, (byte) 4);
    }

    @Tag("full")
    @Test
    void remembersEachTargetByItself() {
        topics.deadLetter("two.dead", "k", new byte[] {1}, Reason.NOT_JSON, "why", Map.of());

        assertThat(redrive("--topic", "two.dead", "--to", "data.first")).startsWith("sent 1 ");
        assertThat(redrive("--topic", "two.dead", "--to", "data.second")).startsWith("sent 1 ");
        assertThat(redrive("--topic", "two.dead", "--to", "data.first")).startsWith("sent 0 ");
    }

    @Tag("full")
    @Test
    void leavesLettersWhoseEventWentOnUnlessTheirStageIsNamed() {
        topics.deadLetterOf("ingest-images", "went.dead", 1, Reason.NOT_AN_IMAGE);
        topics.deadLetterOf("missions", "went.dead", 2, Reason.REFUSED);
        topics.deadLetterOf("ingest", "went.dead", 3, Reason.NOT_JSON);

        assertThat(redrive("--topic", "went.dead"))
                .isEqualTo("sent 1 dead letter from went.dead to went: 1 not-json\n"
                        + "left where they are: 1 not-an-image of ingest-images, whose event went on, "
                        + "1 refused of missions, whose event went on");
        assertThat(redrive("--topic", "went.dead", "--reason", "not-an-image"))
                .as("a reason is not a stage")
                .startsWith("sent 0 ");
        assertThat(redrive("--topic", "went.dead", "--stage", "missions")).contains(": 1 refused\n");
        assertThat(topics.recordsOf("went"))
                .extracting(record -> record.value()[0])
                .containsExactly((byte) 3, (byte) 2);
    }

    @Tag("full")
    @Test
    void bringsBackTheWholeOfWhatALetterStandsFor() {
        byte[] whole = new byte[2_000_000];
        whole[whole.length - 1] = 7;
        topics.deadLetter("large", "other", new byte[] {1}, Map.of());
        OriginalReference place = topics.place("large", "robot", whole, Map.of("trace", "7"));
        topics.standIn("large.dead", "robot", place);
        topics.standIn("large.dead", "another", place);
        topics.standIn("large.dead", "robot", new OriginalReference("large", place.partition(), 99, 2_000_000));
        topics.standIn("large.dead", "robot", new OriginalReference("nowhere", 0, 0, 2_000_000));

        assertThat(redrive("--topic", "large.dead", "--to", "data.whole"))
                .isEqualTo("sent 1 dead letter from large.dead to data.whole: 1 not-json\n"
                        + "left where they are: 3 original gone");
        assertThat(topics.recordsOf("data.whole")).singleElement().satisfies(record -> {
            assertThat(record.value()).isEqualTo(whole);
            assertThat(record.timestamp()).isEqualTo(TIME);
            assertThat(DeadLetterTopics.headers(record)).isEqualTo(Map.of("trace", "7"));
        });
    }

    @Tag("full")
    @Test
    void reportsWhatIsMissing() {
        assertThat(redrive("--topic", "nowhere.dead")).startsWith("unknown-topic: there is no topic 'nowhere.dead'");
        assertThat(redrive("--topic", "data.raw")).startsWith("unknown-topic: 'data.raw' is no topic of dead letters");
        assertThat(redrive()).startsWith("missing-member: ");
        assertThat(redrive("--topic", "once.dead", "--to", "service.domainmanager"))
                .startsWith("topic-not-allowed: letters are not sent to 'service.domainmanager'");
        assertThat(redrive("--topic", "once.dead", "--to", "connect-configs")).startsWith("topic-not-allowed: ");
        assertThat(ask("POST", "/api/dead-letters/redrive", "{\"topic\":\"once.dead\",\"to\":\"data.nowhere\"}")
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
        option(all, "to").ifPresent(topics::create);
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
}
