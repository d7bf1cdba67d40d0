package io.furrow.mission;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Collection;
import java.util.List;
import java.util.Set;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.mission.file.FileRecordings;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class LatestStateTest {
    private static final List<String> LINES = List.of(
            line(
                    "a",
                    10,
                    "farm",
                    "{\"id\":\"t1\",\"type\":\"Robot\",\"x\":{\"value\":1},\"y\":{\"value\":1,\"metadata\":{\"q\":{}}}}"),
            line("b", 11, "farm", "{\"id\":\"t2\",\"type\":\"Robot\",\"x\":{\"value\":2}}"),
            line("c", 12, "other", "{\"id\":\"t1\",\"type\":\"Robot\",\"x\":{\"value\":3}}"),
            line("r", 12, "farm", "{\"id\":\"t1\",\"type\":\"Rover\",\"w\":{\"value\":7}}"),
            line("d", 13, "farm", "{\"id\":\"t1\",\"type\":\"Robot\",\"y\":{\"value\":4},\"z\":{\"value\":5}}"),
            "{\"id\":\"e\",\"time\":14,\"headers\":{\"fiware-service\":\"farm\"},\"entityId\":\"t2\",\"entity\":null}",
            line("f", 15, "farm", "{\"id\":\"t2\",\"type\":\"Robot\",\"z\":{\"value\":6}}"));

    @TempDir
    Path folder;

    @Test
    void mergesTheAttributesOfEachEntityAndKeepsTenantsAndTypesApart() throws Exception {
        assertThat(before(14))
                .extracting(LatestStateTest::text)
                .containsExactly(
                        "b 11 {\"id\":\"t2\",\"type\":\"Robot\",\"x\":{\"value\":2}}",
                        "c 12 {\"id\":\"t1\",\"type\":\"Robot\",\"x\":{\"value\":3}}",
                        "r 12 {\"id\":\"t1\",\"type\":\"Rover\",\"w\":{\"value\":7}}",
                        "d 13 {\"id\":\"t1\",\"type\":\"Robot\",\"x\":{\"value\":1},\"y\":{\"value\":4},\"z\":{\"value\":5}}");
    }

    @Test
    void dropsTheStateBeforeADeletion() throws Exception {
        assertThat(before(15)).extracting(StoredEvent::id).containsExactly("c", "r", "d");
        assertThat(before(16))
                .extracting(LatestStateTest::text)
                .hasSize(4)
                .contains("f 15 {\"id\":\"t2\",\"type\":\"Robot\",\"z\":{\"value\":6}}");
    }

    @Test
    void excludesEventsAtThePoint() throws Exception {
        assertThat(before(10)).isEmpty();
        assertThat(before(11)).extracting(StoredEvent::id).containsExactly("a");
    }

    @Test
    void stopsBetweenPagesWhenItsThreadIsInterrupted() throws Exception {
        Path file = folder.resolve("hoeing.ndjson");
        Files.write(file, LINES);
        try (Recording recording =
                new FileRecordings(file.toString()).open("any").orElseThrow()) {
            Thread.currentThread().interrupt();
            assertThatThrownBy(() -> recording.stateBefore(16, Set.of(), PageLimits.DEFAULT))
                    .isInstanceOf(RecordingInterruptedException.class)
                    .hasMessage("Reading of a recording was interrupted");
            assertThat(Thread.interrupted()).isTrue();
        }
    }

    private Collection<StoredEvent> before(long time) throws Exception {
        Path file = folder.resolve("hoeing.ndjson");
        Files.write(file, LINES);
        try (Recording recording =
                new FileRecordings(file.toString()).open("any").orElseThrow()) {
            Collection<StoredEvent> inOnePage = recording.stateBefore(time, Set.of(), PageLimits.DEFAULT);
            assertThat(recording.stateBefore(time, Set.of(), new PageLimits(2, 1_000)))
                    .isEqualTo(inOnePage);
            return inOnePage;
        }
    }

    private static String line(String id, long time, String service, String entity) {
        return "{\"id\":\"%s\",\"time\":%d,\"headers\":{\"fiware-service\":\"%s\"},\"entity\":%s}"
                .formatted(id, time, service, entity);
    }

    private static String text(StoredEvent event) {
        return event.id() + " " + event.time() + " "
                + new String(io.furrow.model.ngsi.NgsiJson.write(event.entity()), UTF_8);
    }
}
