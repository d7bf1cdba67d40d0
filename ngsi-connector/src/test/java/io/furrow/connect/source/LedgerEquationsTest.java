package io.furrow.connect.source;

import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.atomic.AtomicBoolean;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.producer.RecordMetadata;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.connect.source.SourceRecord;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** A real source, journal and all, under a mixed load: at its quiet moments the ledger's three sums agree. */
class LedgerEquationsTest {
    private static final List<String> BODIES = List.of(
            "{\"id\": \"a\", \"type\": \"T\", \"x\": 1}",
            "{\"data\": [{\"id\": \"b\"}, {\"x\": 7}, {\"id\": \"c\", \"type\": \"Analytics:Collision\"}, {\"id\": \"d\"}]}",
            "no JSON",
            "{\"id\": \"e\", \"type\": \"Domain\"}",
            "{\"id\": \"f\", \"alterationType\": \"entityDelete\"}",
            "{\"type\": \"Notification\", \"data\": [{\"id\": \"g\", \"t\": {\"value\": 1}}, 7]}",
            "{\"data\": []}",
            "");

    private final HttpClient client = HttpClient.newHttpClient();
    private long offset;
    private final Random random = new Random(7);
    private final Map<Map<String, ?>, Map<String, ?>> committed = new HashMap<>();

    @TempDir
    Path directory;

    @Test
    void addsUpUnderAMixedLoadAndAfterARestart() throws Exception {
        NgsiSourceTask first = start();
        AtomicBoolean sending = new AtomicBoolean(true);
        CompletableFuture<Void> load =
                CompletableFuture.runAsync(() -> send(first, 400)).whenComplete((done, failure) -> sending.set(false));
        while (sending.get()) {
            produce(first, 2);
        }
        load.join();

        JsonNode half = quiet(first);
        assertThat(half.get("received").asLong()).isGreaterThan(400);
        assertThat(half.get("excluded").asLong()).isPositive();
        assertThat(half.get("dead").asLong()).isPositive();

        long left = half.get("pending").asLong();
        while (health(first).get("pending").asLong() > 0) {
            produce(first, 10);
        }
        JsonNode whole = quiet(first);
        assertThat(whole.get("produced").asLong() + whole.get("skipped").asLong())
                .isEqualTo(whole.get("durable").asLong());
        send(first, 50);
        long pending = quiet(first).get("pending").asLong();
        first.stop();
        NgsiSourceTask second = start();
        send(second, 50);

        JsonNode recovered = quiet(second);
        assertThat(left).isNotNegative();
        assertThat(recovered.get("recovered").asLong()).isEqualTo(pending).isPositive();
        second.stop();
    }

    @Test
    void addsUpWhereNothingCanBeKept() throws Exception {
        NgsiSourceTask full = start("journal.min.free.bytes", "1000000000000000000", "overload.hold.ms", "100");

        send(full, 40);

        JsonNode health = quiet(full);
        assertThat(health.get("durable").asLong()).isZero();
        assertThat(health.get("rejectedUnavailable").asLong()).isPositive();
        assertThat(health.get("overload").asLong()).isPositive();
        full.stop();
    }

    /** Waits for a quiet moment, which is one in which the sums agree. */
    private JsonNode quiet(NgsiSourceTask task) throws Exception {
        await().untilAsserted(() -> {
            JsonNode now = health(task);
            assertThat(sum(now, "accepted", "dead", "excluded"))
                    .as("received: %s", now)
                    .isEqualTo(sum(now, "received"));
            assertThat(sum(now, "durable", "rejectedUnavailable"))
                    .as("durable: %s", now)
                    .isEqualTo(sum(now, "accepted", "dead", "repaired"));
            assertThat(sum(now, "produced", "skipped", "lost", "pending"))
                    .as("produced: %s", now)
                    .isEqualTo(sum(now, "recovered", "durable"));
        });
        return health(task);
    }

    private static long sum(JsonNode health, String... names) {
        return List.of(names).stream()
                .mapToLong(name -> health.get(name).asLong())
                .sum();
    }

    private void send(NgsiSourceTask task, int count) {
        List<CompletableFuture<HttpResponse<Void>>> answers = new ArrayList<>();
        for (int i = 0; i < count; i++) {
            HttpRequest request = HttpRequest.newBuilder(uri(task, "/v2/notify"))
                    .POST(HttpRequest.BodyPublishers.ofString(BODIES.get(i % BODIES.size())))
                    .build();
            answers.add(client.sendAsync(request, HttpResponse.BodyHandlers.discarding()));
            if (i % 20 == 19) {
                answers.forEach(answer -> answer.exceptionally(reset -> null).join());
            }
        }
        answers.forEach(answer -> answer.exceptionally(reset -> null).join());
    }

    /** Does what a worker does: polls, and commits each record, a few as skipped. */
    private void produce(NgsiSourceTask task, int polls) throws InterruptedException {
        for (int i = 0; i < polls; i++) {
            List<SourceRecord> records = task.poll();
            for (SourceRecord record : records == null ? List.<SourceRecord>of() : records) {
                boolean skipped = random.nextInt(10) == 0;
                committed.put(record.sourcePartition(), record.sourceOffset());
                task.commitRecord(
                        record, skipped ? null : new RecordMetadata(new TopicPartition("t", 0), offset++, 0, 0, 0, 0));
            }
        }
    }

    private JsonNode health(NgsiSourceTask task) throws Exception {
        HttpResponse<byte[]> answer = client.send(
                HttpRequest.newBuilder(uri(task, "/health")).build(), HttpResponse.BodyHandlers.ofByteArray());
        return NgsiJson.read(answer.body());
    }

    private static URI uri(NgsiSourceTask task, String path) {
        return URI.create("http://127.0.0.1:" + task.port() + path);
    }

    private NgsiSourceTask start(String... options) {
        Map<String, String> all =
                new HashMap<>(Map.of("name", "farm", "listen.port", "0", "journal.dir", directory.toString()));
        for (int i = 0; i < options.length; i += 2) {
            all.put(options[i], options[i + 1]);
        }
        NgsiSourceTask task = new NgsiSourceTask();
        task.initialize(new StubContext(all, committed));
        task.start(all);
        return task;
    }
}
