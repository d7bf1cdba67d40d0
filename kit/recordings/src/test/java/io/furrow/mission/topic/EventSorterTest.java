package io.furrow.mission.topic;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.TreeMap;
import java.util.concurrent.atomic.AtomicLong;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.mission.Cursor;
import io.furrow.mission.RecordingDeletedException;
import io.furrow.mission.RecordingInterruptedException;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class EventSorterTest {
    private static final String[] CHARACTERS = {"a", "b", "Z", "é", "\uFFFD", "\uD83D\uDE9C"};

    @Test
    void sortsMoreEventsThanFitIntoMemoryAndKeepsTheFirstOfDuplicates(@TempDir Path folder) throws Exception {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        for (int events : new int[] {0, 1, 30, 3_000}) {
            EventSorter sorter = new EventSorter(new DiskSpace(folder, 0, () -> Long.MAX_VALUE), 2_000);
            TreeMap<Cursor, SortedEvent> expected = new TreeMap<>();
            for (int i = 0; i < events; i++) {
                String id = CHARACTERS[random.nextInt(CHARACTERS.length)] + random.nextInt(events);
                String line = "x".repeat(random.nextInt(100)) + i;
                SortedEvent event = new SortedEvent(
                        new Cursor(random.nextInt(50), id),
                        random.nextInt(3),
                        random.nextInt(10_000),
                        line.getBytes(UTF_8));
                sorter.add(event);
                expected.merge(event.at(), event, EventSorterTest::first);
            }
            Path lines = folder.resolve("lines");

            sorter.writeLines(lines);

            List<String> texts = new ArrayList<>();
            expected.values().forEach(event -> texts.add(new String(event.line(), UTF_8)));
            assertThat(Files.readAllLines(lines)).as("seed %d", seed).isEqualTo(texts);
            assertThat(folder).isDirectoryContaining(lines::equals);
            Files.delete(lines);
            assertThat(folder).isEmptyDirectory();
        }
    }

    @Test
    void stopsMergingWhenItsThreadIsInterrupted(@TempDir Path folder) throws Exception {
        EventSorter sorter = new EventSorter(new DiskSpace(folder, 0, () -> Long.MAX_VALUE), 2_000);
        sorter.add(new SortedEvent(new Cursor(1, "a"), 0, 0, new byte[0]));
        Thread.currentThread().interrupt();
        assertThatThrownBy(() -> sorter.writeLines(folder.resolve("lines")))
                .isInstanceOf(RecordingInterruptedException.class);
        assertThat(Thread.interrupted()).isTrue();
    }

    @Test
    void leavesSpaceOnTheDiskWhileItMerges(@TempDir Path folder) throws Exception {
        AtomicLong free = new AtomicLong(30_000_000);
        EventSorter sorter = new EventSorter(new DiskSpace(folder, 20_000_000, free::get), 2_000);
        sorter.add(new SortedEvent(new Cursor(1, "a"), 0, 0, new byte[3_000]));
        free.set(20_002_000);

        assertThatThrownBy(() -> sorter.writeLines(folder.resolve("lines")))
                .isInstanceOf(RecordingDeletedException.class)
                .hasMessageContaining("19 MiB are free there, and 19 MiB have to stay free");
        assertThatThrownBy(() -> sorter.add(new SortedEvent(new Cursor(1, "b"), 0, 0, new byte[3_000])))
                .isInstanceOf(RecordingDeletedException.class);
    }

    private static SortedEvent first(SortedEvent one, SortedEvent other) {
        return SortedEvent.ORDER.compare(one, other) <= 0 ? one : other;
    }
}
