package io.furrow.connect.source;

import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.connect.ConnectRig;
import io.furrow.connect.TopicReader;
import io.furrow.embedded.FreePort;
import io.furrow.files.Folders;
import io.furrow.model.event.HeaderNames;
import io.furrow.process.Ports;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** What users of Connect do with a source that keeps a journal, on a worker that delivers exactly once. */
class NgsiOffsetsIT {
    @TempDir
    static Path directory;

    @AutoClose
    private static ConnectRig rig;

    @BeforeAll
    static void startWorker() {
        rig = ConnectRig.start(directory, Map.of("exactly.once.source.support", "enabled"));
    }

    @Tag("full")
    @Test
    void answersWhileItIsPausedAndWritesEachOnceWhenItIsResumed() throws Exception {
        SourceOnConnect source = create("paused");
        List<String> ids = new ArrayList<>(source.take("before", 2));
        source.awaitDrained();

        rig.pause("paused");
        ids.addAll(source.take("meanwhile", 20));
        assertThat(source.ledger("durable")).isEqualTo(22);
        SourceOnConnect.await().during(Duration.ofSeconds(1)).until(() -> source.ledger("pending") == 20);
        assertThat(keys("paused")).containsExactlyInAnyOrder("before-0", "before-1");

        rig.resume("paused");
        source.awaitDrained();
        assertThat(keys("paused")).containsExactlyInAnyOrderElementsOf(ids);
    }

    /** Connect does not start a paused task, so after the restart nobody listens until it is resumed. */
    @Tag("full")
    @Test
    void losesAndRepeatsNothingWhenConnectorAndTaskAreRestarted() throws Exception {
        SourceOnConnect source = create("restarted");
        List<String> ids = new ArrayList<>(source.take("before", 2));
        source.awaitDrained();
        rig.pause("restarted");
        ids.addAll(source.take("pending", 20));

        rig.ask("POST", "/connectors/restarted/restart?includeTasks=true", "");
        source.awaitSilence();
        rig.resume("restarted");
        source.awaitFewerRequestsThan(22);
        assertThat(source.ledger("recovered")).isEqualTo(20);
        source.awaitDrained();
        ids.addAll(source.take("between", 2));
        rig.ask("POST", "/connectors/restarted/tasks/0/restart", "");
        source.awaitFewerRequestsThan(2);
        ids.addAll(source.take("after", 2));

        source.awaitDrained();
        assertThat(keys("restarted")).containsExactlyInAnyOrderElementsOf(ids);
    }

    @Tag("full")
    @Test
    void showsEachRecordOnceToWhoReadsCommittedWhenItIsRestartedUnderLoad() throws Exception {
        SourceOnConnect source = create("loaded");
        ConcurrentLinkedQueue<String> answered = new ConcurrentLinkedQueue<>();
        AtomicBoolean ending = new AtomicBoolean();
        CompletableFuture<?>[] senders = Stream.of("a", "b", "c", "d")
                .map(name -> CompletableFuture.runAsync(() -> send(source, name, answered, ending)))
                .toArray(CompletableFuture<?>[]::new);

        for (String path : List.of("/restart?includeTasks=true", "/tasks/0/restart", "/restart?includeTasks=true")) {
            SourceOnConnect.await().until(() -> source.ledger("produced") > 200);
            long requests = source.ledger("requests");
            rig.ask("POST", "/connectors/loaded" + path, "");
            source.awaitFewerRequestsThan(requests);
        }
        SourceOnConnect.await().until(() -> source.ledger("produced") > 200);
        ending.set(true);
        CompletableFuture.allOf(senders).join();

        source.awaitDrained();
        assertThat(keys("loaded")).doesNotHaveDuplicates().containsAll(answered);
    }

    @Tag("full")
    @Test
    void repeatsFromAnEarlierRecordWithTheSameEventIds() throws Exception {
        SourceOnConnect source = create("earlier");
        source.take("taken", 5);
        source.awaitDrained();
        rig.stop("earlier");
        JsonNode offset = offset("earlier");
        assertThat(offset.path("offset").toString()).isEqualTo("{\"record\":5}");

        alter("earlier", offset.path("partition"), "{\"record\":2}");
        rig.resume("earlier");
        source.awaitListening();
        source.awaitDrained();

        Map<String, List<String>> eventsOf = new HashMap<>();
        for (ConsumerRecord<String, byte[]> record : records("earlier")) {
            eventsOf.computeIfAbsent(record.key(), key -> new ArrayList<>()).add(event(record));
        }
        Set<String> events = new HashSet<>();
        eventsOf.forEach((key, copies) -> {
            assertThat(copies).as(key).hasSize(Set.of("taken-0", "taken-1").contains(key) ? 1 : 2);
            events.addAll(copies);
        });
        assertThat(events).hasSize(5);
    }

    @Tag("full")
    @Test
    void writesWhatComesLaterBehindAnOffsetBeyondTheEnd() throws Exception {
        SourceOnConnect source = create("beyond");
        List<String> ids = new ArrayList<>(source.take("taken", 3));
        source.awaitDrained();
        rig.stop("beyond");
        alter("beyond", offset("beyond").path("partition"), "{\"record\":1000}");
        rig.resume("beyond");
        source.awaitListening();

        ids.addAll(source.take("later", 2));
        source.awaitDrained();
        assertThat(keys("beyond")).containsExactlyInAnyOrderElementsOf(ids);
        rig.stop("beyond");
        assertThat(offset("beyond").path("offset").toString()).isEqualTo("{\"record\":1002}");
    }

    @Tag("full")
    @Test
    void repeatsAllThatIsKeptAfterAReset() throws Exception {
        SourceOnConnect source = create("reset");
        List<String> ids = new ArrayList<>(source.take("taken", 3));
        source.awaitDrained();
        rig.stop("reset");
        assertThat(rig.ask("DELETE", "/connectors/reset/offsets", "").statusCode())
                .isEqualTo(200);
        assertThat(rig.get("/connectors/reset/offsets").path("offsets")).isEmpty();

        rig.resume("reset");
        source.awaitListening();
        source.awaitDrained();

        ids.addAll(List.copyOf(ids));
        assertThat(keys("reset")).containsExactlyInAnyOrderElementsOf(ids);
    }

    /** Connect makes 500 of whatever a connector says to this. */
    @Tag("full")
    @Test
    void saysWhatIsWrongWithPartitionsAndOffsetsOfAnotherShape() throws Exception {
        create("malformed").take("taken", 1);
        rig.stop("malformed");
        String journal = "{\"journal\": \"0-0123456789abcdef\"}";
        Map<String, String> sentences = Map.of(
                body("{\"file\": \"a\"}", "{\"record\": 1}"), "a partition is {\\\"journal\\\": \\\"<id>\\\"}",
                body("{\"journal\": 7}", "{\"record\": 1}"), "a partition is {\\\"journal\\\": \\\"<id>\\\"}",
                body(journal, "{\"record\": -1}"), "an offset is {\\\"record\\\": n} with a whole number",
                body(journal, "{\"record\": \"7\"}"), "an offset is {\\\"record\\\": n} with a whole number",
                body(journal, "{\"record\": 1.5}"), "an offset is {\\\"record\\\": n} with a whole number",
                body(journal, "{\"position\": 1}"), "an offset is {\\\"record\\\": n} with a whole number");

        sentences.forEach((body, sentence) -> {
            HttpResponse<String> answer = rig.ask("PATCH", "/connectors/malformed/offsets", body);
            assertThat(answer.statusCode()).as(answer.body()).isEqualTo(500);
            assertThat(answer.body()).contains(sentence);
        });
    }

    @Tag("full")
    @Test
    void drainsAndRemovesTheJournalOfATaskThatIsNoMore() throws Exception {
        int port = twoFreePorts();
        Map<String, String> options = options("fewer", port);
        options.put("tasks.max", "2");
        options.put("journal.retention.ms", "1000");
        rig.create("fewer", "ngsi-source-exactly-once", options);
        SourceOnConnect first = new SourceOnConnect(port);
        SourceOnConnect second = new SourceOnConnect(port + 1);
        first.awaitListening();
        second.awaitListening();
        rig.pause("fewer");
        List<String> ids = new ArrayList<>(first.take("first", 3));
        ids.addAll(second.take("second", 3));
        rig.stop("fewer");
        assertThat(journals("fewer")).hasSize(2);

        options.put("tasks.max", "1");
        rig.configure("fewer", "ngsi-source-exactly-once", options);
        rig.resume("fewer");
        first.awaitListening();

        SourceOnConnect.await()
                .untilAsserted(() ->
                        assertThat(journals("fewer")).singleElement().asString().startsWith("0-"));
        first.awaitDrained();
        assertThat(keys("fewer")).containsExactlyInAnyOrderElementsOf(ids);
    }

    private static SourceOnConnect create(String name) {
        int port = FreePort.orFree(0);
        rig.create(name, "ngsi-source-exactly-once", options(name, port));
        SourceOnConnect source = new SourceOnConnect(port);
        source.awaitListening();
        return source;
    }

    private static Map<String, String> options(String name, int port) {
        return new HashMap<>(Map.of("topic", name, "listen.port", Integer.toString(port), "tasks.max", "1"));
    }

    private static int twoFreePorts() {
        return Stream.generate(() -> FreePort.orFree(0))
                .filter(port -> Ports.isFree(port + 1))
                .findFirst()
                .orElseThrow();
    }

    private static void send(
            SourceOnConnect source, String name, ConcurrentLinkedQueue<String> answered, AtomicBoolean ending) {
        try {
            for (int i = 0; !ending.get(); i++) {
                String id = name + "-" + i;
                if (source.post(id) == 200) {
                    answered.add(id);
                }
            }
        } catch (InterruptedException e) {
            throw new IllegalStateException(e);
        }
    }

    private static JsonNode offset(String connector) {
        JsonNode offsets = rig.get("/connectors/" + connector + "/offsets").path("offsets");
        assertThat(offsets).as(connector).hasSize(1);
        return offsets.path(0);
    }

    private static void alter(String connector, JsonNode partition, String offset) {
        HttpResponse<String> answer =
                rig.ask("PATCH", "/connectors/" + connector + "/offsets", body(partition.toString(), offset));
        assertThat(answer.statusCode()).as(answer.body()).isEqualTo(200);
    }

    private static String body(String partition, String offset) {
        return "{\"offsets\": [{\"partition\": " + partition + ", \"offset\": " + offset + "}]}";
    }

    private static List<String> keys(String topic) {
        return records(topic).stream().map(ConsumerRecord::key).toList();
    }

    private static List<ConsumerRecord<String, byte[]>> records(String topic) {
        try (TopicReader reader = new TopicReader(rig.bootstrapServers(), topic)) {
            return reader.toTheEnd();
        }
    }

    private static String event(ConsumerRecord<String, byte[]> record) {
        return new String(record.headers().lastHeader(HeaderNames.CE_ID).value(), UTF_8);
    }

    private static List<Path> journals(String connector) throws Exception {
        return Folders.list(rig.journals().resolve(connector)).stream()
                .map(Path::getFileName)
                .toList();
    }
}
