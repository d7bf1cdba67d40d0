package io.furrow.mission.file;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Instant;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Random;
import java.util.TreeMap;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.files.Gzip;
import io.furrow.mission.Cursor;
import io.furrow.mission.EventOrder;
import io.furrow.mission.EventPage;
import io.furrow.mission.PageLimits;
import io.furrow.mission.RandomEvents;
import io.furrow.mission.Recording;
import io.furrow.mission.RecordingContract;
import io.furrow.mission.RecordingDeletedException;
import io.furrow.mission.RecordingException;
import io.furrow.mission.RecordingExtent;
import io.furrow.mission.RecordingInterruptedException;
import io.furrow.mission.StoredEvent;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class FileRecordingTest extends RecordingContract {
    private static final PageLimits ALL = new PageLimits(1_000_000, Integer.MAX_VALUE);

    @TempDir
    Path folder;

    @Override
    public Recording recorded(List<StoredEvent> events) throws Exception {
        Path file = Files.createTempFile(folder, "mission", ".ndjson");
        Files.write(file, lines(ordered(events)));
        return new FileRecordings(file.toString()).open("any").orElseThrow();
    }

    @Override
    public int bytes(StoredEvent event) {
        return ArchiveLine.write(event).length;
    }

    @Test
    void findsTheFileOfAMissionAndReadsCompressedFiles() throws Exception {
        Files.write(folder.resolve("hoeing.ndjson.gz"), Gzip.of(lines(List.of(RandomEvents.event("a", 1, 0)))));
        Files.write(folder.resolve("_x-a-2Eb.jsonl"), lines(List.of(RandomEvents.event("b", 1, 0))));
        FileRecordings recordings = new FileRecordings(folder.toString());

        assertThat(ids(recordings, "hoeing")).containsExactly("a");
        assertThat(ids(recordings, "a.b")).containsExactly("b");
        assertThat(recordings.open("weeding")).isEmpty();
        assertThatThrownBy(() -> new FileRecordings(folder + "/nowhere").open("hoeing"))
                .isInstanceOf(RecordingException.class)
                .hasMessageContaining("There is no file or folder " + folder + "/nowhere");
    }

    @Test
    void ignoresFilesOfMarkers() throws Exception {
        Path archive = Files.createDirectory(folder.resolve("mission_weeding"));
        byte[] event = lines(List.of(RandomEvents.event("a", 1, 0)));
        Files.write(archive.resolve("2026-11-20-0001.jsonl"), event);
        Files.write(archive.resolve("2026-11-20-0001.markers.jsonl"), event);
        Files.write(folder.resolve("hoeing.markers.jsonl"), event);
        FileRecordings recordings = new FileRecordings(folder.toString());

        assertThat(recordings.open("hoeing.markers")).isEmpty();
        assertThat(recordings.open("hoeing")).isEmpty();
        try (Recording recording = recordings.open("weeding").orElseThrow()) {
            assertThat(recording.read(Cursor.START, ALL).skipped()).isEmpty();
        }
        assertThatThrownBy(() -> new FileRecordings(folder + "/hoeing.markers.jsonl").open("hoeing"))
                .isInstanceOf(RecordingException.class)
                .hasMessage(folder + "/hoeing.markers.jsonl holds markers and no events; name the file of the mission,"
                        + " which lies beside it");
    }

    @Test
    void readsAnArchiveOfManyDaysAndParts() throws Exception {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        long day = Instant.parse("2026-11-20T00:00:00Z").toEpochMilli();
        TreeMap<String, List<StoredEvent>> parts = new TreeMap<>();
        List<StoredEvent> all = new ArrayList<>();
        for (int i = 0; i < 300; i++) {
            long time = day + random.nextInt(3) * 86_400_000L + random.nextInt(20) * 4_320_000L;
            StoredEvent event = RandomEvents.event("e" + i, time, random.nextInt(50));
            String part = Instant.ofEpochMilli(time).toString().substring(0, 10) + "-000" + (1 + random.nextInt(3));
            parts.computeIfAbsent(part, ignored -> new ArrayList<>()).add(event);
            all.add(event);
        }
        Path archive = Files.createDirectory(folder.resolve("mission_hoeing"));
        for (String part : parts.keySet()) {
            Files.write(archive.resolve(part + ".ndjson.gz"), Gzip.of(lines(ordered(parts.get(part)))));
        }
        List<StoredEvent> ordered = ordered(all);
        try (Recording recording =
                new FileRecordings(folder.toString()).open("hoeing").orElseThrow()) {
            assertThat(recording.read(Cursor.START, ALL).events())
                    .as("seed %d", seed)
                    .isEqualTo(ordered);
            for (int i = 0; i < 30; i++) {
                StoredEvent any = ordered.get(random.nextInt(ordered.size()));
                List<StoredEvent> rest = ordered.stream()
                        .filter(event -> EventOrder.COMPARATOR.compare(event, any) > 0)
                        .toList();
                assertThat(recording.read(Cursor.after(any), ALL).events())
                        .as("seed %d", seed)
                        .isEqualTo(rest);
            }
            assertThat(recording.span())
                    .contains(new RecordingExtent(
                            ordered.get(0).time(), ordered.get(299).time()));
        }
    }

    @Test
    void continuesInAFileOfSeveralDaysNamedAfterTheFirst() throws Exception {
        long evening = Instant.parse("2026-11-20T20:00:00Z").toEpochMilli();
        StoredEvent first = RandomEvents.event("a", evening, 0);
        StoredEvent second = RandomEvents.event("b", evening + 8 * 3_600_000, 0);
        StoredEvent third = RandomEvents.event("c", evening + 9 * 3_600_000, 0);
        Files.write(folder.resolve("2026-11-20-night.ndjson"), lines(List.of(first, second, third)));
        try (Recording recording =
                new FileRecordings(folder.toString()).open("2026-11-20-night").orElseThrow()) {
            assertThat(recording.read(Cursor.after(second), ALL).events()).containsExactly(third);
        }
    }

    @Test
    void reportsInvalidLines() throws Exception {
        Path file = folder.resolve("hoeing.ndjson");
        String good = new String(lines(List.of(RandomEvents.event("a", 1, 0))), UTF_8);
        String noEntity = "{\"id\":\"b\",\"time\":2,\"headers\":{}}\n";
        String cut = "{\"id\":\"c\",\"time\":3,\"hea";
        Files.writeString(file, "nonsense\n" + good + good + noEntity + "\n[]\n" + cut);
        try (Recording recording =
                new FileRecordings(file.toString()).open("any").orElseThrow()) {
            EventPage eventPage = recording.read(Cursor.START, ALL);

            assertThat(eventPage.events()).extracting(StoredEvent::id).containsExactly("a");
            assertThat(eventPage.skipped())
                    .extracting(skippedRecords ->
                            skippedRecords.what().substring(file.toString().length()))
                    .containsExactly(", line 1", ", line 3", ", line 4", ", line 5", ", line 6", ", line 7");
            assertThat(eventPage.last()).isTrue();
        }
    }

    @Test
    void rejectsLinesThatAreOutOfOrder() throws Exception {
        Path file = folder.resolve("hoeing.ndjson");
        List<StoredEvent> events =
                List.of(RandomEvents.event("a", 1, 0), RandomEvents.event("b", 3, 0), RandomEvents.event("c", 2, 0));
        Files.write(file, lines(events));
        try (Recording recording =
                new FileRecordings(file.toString()).open("any").orElseThrow()) {
            assertThat(recording.read(Cursor.START, new PageLimits(1, 1)).events())
                    .hasSize(1);
            assertThatThrownBy(() -> recording.read(Cursor.START, ALL))
                    .isInstanceOf(RecordingException.class)
                    .hasMessageStartingWith(file + ", line 3 is out of order");
            assertThatThrownBy(recording::span).isInstanceOf(RecordingException.class);
        }
    }

    /** A seek may read a long file for minutes. */
    @Test
    void stopsSeekingAndMeasuringWhenItsThreadIsInterrupted() throws Exception {
        Path file = folder.resolve("hoeing.ndjson");
        Files.write(file, lines(ordered(RandomEvents.of(new Random(1), 100))));
        RecordingFiles interrupting = new InterruptingFiles();
        try (Recording recording =
                new FileRecordings(file.toString(), interrupting).open("any").orElseThrow()) {
            assertThatThrownBy(() -> recording.read(Cursor.before(Long.MAX_VALUE), ALL))
                    .isInstanceOf(RecordingInterruptedException.class);
            assertThat(Thread.interrupted()).isTrue();
            assertThatThrownBy(recording::span).isInstanceOf(RecordingInterruptedException.class);
            assertThat(Thread.interrupted()).isTrue();
        }
    }

    /** Interrupts the thread that opens a file. */
    private static final class InterruptingFiles implements RecordingFiles {
        private static final long serialVersionUID = 1L;

        @Override
        public boolean isFolder(String path) throws IOException {
            return LOCAL.isFolder(path);
        }

        @Override
        public boolean exists(String path) throws IOException {
            return LOCAL.exists(path);
        }

        @Override
        public List<String> names(String path) throws IOException {
            return LOCAL.names(path);
        }

        @Override
        public InputStream open(String file) throws IOException {
            Thread.currentThread().interrupt();
            return LOCAL.open(file);
        }
    }

    @Test
    void rejectsTruncatedAndDeletedFiles() throws Exception {
        Path file = folder.resolve("hoeing.ndjson.gz");
        byte[] whole = Gzip.of(lines(ordered(RandomEvents.of(new Random(1), 500))));
        Files.write(file, Arrays.copyOf(whole, whole.length / 2));
        try (Recording recording =
                new FileRecordings(file.toString()).open("any").orElseThrow()) {
            assertThatThrownBy(() -> recording.read(Cursor.START, ALL))
                    .isInstanceOf(RecordingException.class)
                    .hasMessageContaining("is damaged or not whole")
                    .hasMessageEndingWith("Export it again.");
            Files.delete(file);
            assertThatThrownBy(() -> recording.read(Cursor.START, ALL)).isInstanceOf(RecordingDeletedException.class);
        }
    }

    private static List<String> ids(FileRecordings recordings, String mission) throws Exception {
        try (Recording recording = recordings.open(mission).orElseThrow()) {
            return recording.read(Cursor.START, ALL).events().stream()
                    .map(StoredEvent::id)
                    .toList();
        }
    }

    private static byte[] lines(List<StoredEvent> events) {
        ByteArrayOutputStream out = new ByteArrayOutputStream();
        for (StoredEvent event : events) {
            out.writeBytes(ArchiveLine.write(event));
            out.write('\n');
        }
        return out.toByteArray();
    }
}
