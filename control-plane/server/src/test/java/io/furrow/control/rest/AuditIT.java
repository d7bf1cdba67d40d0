package io.furrow.control.rest;

import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.IntStream;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestInstance;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.control.rest.view.AuditHistory;
import io.furrow.control.rest.view.StateView;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Pages through more audit entries than the API caches and than one request reads. */
@TestInstance(TestInstance.Lifecycle.PER_CLASS)
@Tag("full")
class AuditIT {
    private static final int ENTRIES = AuditHistory.MAX_READ + 3 * StateView.AUDITED;
    private static final Pattern NEXT = Pattern.compile("<(\\?[^>]+)>; ?rel=\"next\"");

    @AutoClose
    private RunningApi running;

    @BeforeAll
    void start(@TempDir Path directory) throws Exception {
        running = new RunningApi(directory);
        try (KafkaProducer<String, byte[]> producer =
                KafkaClients.producer(running.settings().client())) {
            for (int i = 0; i < ENTRIES; i++) {
                producer.send(new ProducerRecord<>(Topics.AUDIT, entry(i)));
            }
        }
        await().until(() -> running.get("/api/audit?limit=1").at("/0/time").asInt() == ENTRIES - 1);
    }

    /** The first entry and one of the last are about a separate mission. */
    private static byte[] entry(int i) {
        String mission = i == 0 || i == ENTRIES - 5 ? "rare" : "usual";
        return """
                {"time":%d,"user":"olga","target":"device","command":"on","about":{"mission":"%s"},"result":"sent"}""".formatted(i, mission).getBytes(UTF_8);
    }

    private record Page(List<Integer> times, String next) {}

    private Page page(String path) throws Exception {
        HttpResponse<byte[]> answer = running.client().send("GET", path, null);
        assertThat(answer.statusCode()).as(path).isEqualTo(200);
        List<Integer> times = new ArrayList<>();
        for (JsonNode each : running.client().json(answer)) {
            times.add(each.path("time").asInt());
        }
        Matcher next = NEXT.matcher(answer.headers().firstValue("Link").orElse(""));
        return new Page(times, next.matches() ? "/api/audit" + next.group(1) : null);
    }

    @Test
    void pagesBackToTheOldestEntryWithoutGapsOrDuplicates() throws Exception {
        List<Integer> times = new ArrayList<>();
        for (String path = "/api/audit?limit=700"; path != null; ) {
            Page page = page(path);
            assertThat(page.times()).hasSizeLessThanOrEqualTo(700);
            times.addAll(page.times());
            path = page.next();
        }

        assertThat(times)
                .containsExactlyElementsOf(IntStream.range(0, ENTRIES)
                        .mapToObj(i -> ENTRIES - 1 - i)
                        .toList());
    }

    @Test
    void findsOldEntriesOfAMissionInBoundedSteps() throws Exception {
        Page first = page("/api/audit?mission=rare&limit=10");
        assertThat(first.times()).containsExactly(ENTRIES - 5);
        assertThat(first.next()).contains("mission=rare").contains("limit=10");

        Page second = page(first.next());
        assertThat(second.times()).isEmpty();
        assertThat(second.next()).isNotNull();

        Page third = page(second.next());
        assertThat(third.times()).containsExactly(0);
        assertThat(third.next()).isNull();
    }

    @Test
    void rejectsAnInvalidPosition() throws Exception {
        for (String before : List.of("-1", "noon", "1.5", "9999999999999999999")) {
            running.rejects("GET", "/api/audit?before=" + before, null, 400, "wrong-member");
        }
        assertThat(page("/api/audit?before=0").times()).isEmpty();
        assertThat(page("/api/audit?before=0").next()).isNull();
    }
}
