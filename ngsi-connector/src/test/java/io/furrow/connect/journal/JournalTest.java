package io.furrow.connect.journal;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.TimeUnit;
import java.util.stream.IntStream;
import java.util.stream.Stream;

import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.files.Folders;
import io.furrow.unchecked.Unchecked;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

class JournalTest {
    private static final JournalSettings SMALL = new JournalSettings(64 * 1024, 4 * 1024, 8 * 1024, 0);

    private Path folder;

    @BeforeEach
    void makeFolder(@TempDir Path parent) throws IOException {
        folder = Files.createDirectory(parent.resolve("0-journal"));
    }

    @Test
    void readsWhatWasAppendedInItsOrder() throws Exception {
        try (Journal journal = open(SMALL)) {
            append(journal, "a", "b");
            append(journal, "c");

            JournalReader reader = journal.reader(0);
            assertThat(read(reader)).containsExactly("0 a", "1 b", "2 c");
            assertThat(reader.position()).isEqualTo(3);
            assertThat(journal.end()).isEqualTo(3);
            append(journal, "d");
            assertThat(read(reader)).containsExactly("3 d");
        }
    }

    @Test
    void goesOnWhereItWasAfterItWasClosed() throws Exception {
        for (int i = 0; i < 5; i++) {
            try (Journal journal = open(SMALL)) {
                assertThat(journal.end()).isEqualTo(i);
                append(journal, "record " + i);
            }
        }
        try (Journal journal = open(SMALL)) {
            assertThat(read(journal.reader(0)))
                    .containsExactly("0 record 0", "1 record 1", "2 record 2", "3 record 3", "4 record 4");
            assertThat(read(journal.reader(3))).containsExactly("3 record 3", "4 record 4");
            assertThat(journal.damages()).isEmpty();
        }
    }

    @Test
    void makesTheNextFileAheadAndLeavesNoneBehind() throws Exception {
        try (Journal journal = open(SMALL)) {
            append(journal, "a");

            Path spare = folder.resolve("spare.segment.tmp");
            await().untilAsserted(() -> assertThat(spare).exists());
            append(journal, "b".repeat(4000));
            assertThat(read(journal.reader(0))).hasSize(2);
        }
        assertThat(folder.resolve("spare.segment.tmp")).doesNotExist();
    }

    @Test
    void showsNothingThatIsNotDurable() throws Exception {
        StubbornDisk disk = new StubbornDisk();
        try (Journal journal = Journal.open(folder, SMALL, disk).orElseThrow()) {
            append(journal, "a");
            disk.holdSyncs();
            CompletableFuture<Void> held = journal.append(payloads("b")).orElseThrow();
            disk.awaitHeldSync();

            JournalReader reader = journal.reader(0);
            assertThat(read(reader)).containsExactly("0 a");
            assertThat(held).isNotDone();
            disk.letSyncsGo();
            held.get(60, TimeUnit.SECONDS);
            assertThat(read(reader)).containsExactly("1 b");
        }
    }

    @Test
    void syncsOnceForAllThatCameWhileTheDiskWasBusy() throws Exception {
        StubbornDisk disk = new StubbornDisk();
        try (Journal journal = Journal.open(folder, SMALL, disk).orElseThrow()) {
            append(journal, "first");
            disk.holdSyncs();
            List<CompletableFuture<Void>> held = new ArrayList<>();
            held.add(journal.append(payloads("alone")).orElseThrow());
            disk.awaitHeldSync();
            int before = disk.syncs();
            IntStream.range(0, 20)
                    .forEach(i ->
                            held.add(journal.append(payloads("with others")).orElseThrow()));
            disk.letSyncsGo();
            for (CompletableFuture<Void> one : held) {
                one.get(60, TimeUnit.SECONDS);
            }
            assertThat(disk.syncs() - before).isEqualTo(1);
        }
    }

    @Test
    void wakesAReaderThatWaits() throws Exception {
        try (Journal journal = open(SMALL)) {
            JournalReader reader = journal.reader(0);
            CompletableFuture<List<JournalRecord>> waiting = CompletableFuture.supplyAsync(
                    () -> Unchecked.get(() -> reader.read(10, 1000, Duration.ofSeconds(30))));
            append(journal, "news");
            assertThat(waiting.get(60, TimeUnit.SECONDS)).hasSize(1);
        }
    }

    @Test
    void readsNoMoreThanAsked() throws Exception {
        try (Journal journal = open(SMALL)) {
            append(journal, "aaaa", "bbbb", "cccc", "dddd");
            JournalReader reader = journal.reader(0);
            assertThat(reader.read(3, 1000, Duration.ZERO)).hasSize(3);
            assertThat(reader.read(3, 1000, Duration.ZERO)).hasSize(1);
            assertThat(journal.reader(0).read(10, 5, Duration.ZERO)).hasSize(2);
        }
    }

    @Test
    void fillsManySegmentsAndTakesALargeRecord() throws Exception {
        String large = "x".repeat(20_000);
        List<String> expected = new ArrayList<>();
        try (Journal journal = open(SMALL)) {
            for (int i = 0; i < 20; i++) {
                String text = i == 10 ? large : "record " + i + "y".repeat(800);
                append(journal, text);
                expected.add(i + " " + text);
            }
            assertThat(read(journal.reader(0))).isEqualTo(expected);
            assertThat(segmentFiles()).hasSizeGreaterThan(4);
        }
        try (Journal journal = open(SMALL)) {
            assertThat(read(journal.reader(0))).isEqualTo(expected);
            assertThat(read(journal.reader(15))).isEqualTo(expected.subList(15, 20));
            assertThat(journal.damages()).isEmpty();
        }
    }

    @Test
    void hasNoRoomWhenItIsFullUntilSomethingIsReleased() throws Exception {
        try (Journal journal = open(SMALL)) {
            int taken = 0;
            while (taken < 1000 && tryAppend(journal, "z".repeat(1000))) {
                taken++;
            }
            assertThat(taken).isBetween(30, 64);
            assertThat(journal.bytes()).isLessThanOrEqualTo(SMALL.maxBytes());

            journal.release(taken / 2);
            assertThat(tryAppend(journal, "room again")).isTrue();
            List<String> left = read(journal.reader(0));
            assertThat(left.get(left.size() - 1)).isEqualTo(taken + " room again");
            assertThat(journal.begin()).isBetween(1L, (long) taken / 2);
        }
    }

    @Test
    void hasNoRoomWhenTheDiskIsNearlyFull() throws Exception {
        StubbornDisk disk = new StubbornDisk();
        JournalSettings settings = new JournalSettings(64 * 1024, 4 * 1024, 8 * 1024, 1_000_000);
        try (Journal journal = Journal.open(folder, settings, disk).orElseThrow()) {
            disk.usable(1_000_000);
            assertThat(journal.append(payloads("a"))).isEmpty();
            disk.usable(2_000_000);
            append(journal, "a");
        }
    }

    @Test
    void boundsWhatWaitsForTheDisk() throws Exception {
        StubbornDisk disk = new StubbornDisk();
        try (Journal journal = Journal.open(folder, SMALL, disk).orElseThrow()) {
            disk.holdSyncs();
            List<CompletableFuture<Void>> taken = new ArrayList<>();
            for (int i = 0; i < 100; i++) {
                journal.append(payloads("w".repeat(1000))).ifPresent(taken::add);
            }
            assertThat(taken).hasSizeBetween(6, 8);
            assertThat(journal.waitingBytes()).isLessThanOrEqualTo(SMALL.maxWaiting());
            disk.letSyncsGo();
            CompletableFuture.allOf(taken.toArray(CompletableFuture[]::new)).get(60, TimeUnit.SECONDS);
            assertThat(journal.waitingBytes()).isZero();
        }
    }

    @Test
    void releasesWholeSegmentsButNeverTheNewest() throws Exception {
        try (Journal journal = open(SMALL)) {
            for (int i = 0; i < 20; i++) {
                append(journal, "r".repeat(1000));
            }
            journal.release(20);
            assertThat(segmentFiles()).hasSize(1);
            assertThat(journal.end()).isEqualTo(20);
        }
        try (Journal journal = open(SMALL)) {
            journal.release(20);
            assertThat(journal.end()).isEqualTo(20);
            append(journal, "next");
            journal.release(20);
            List<String> kept = read(journal.reader(0));
            assertThat(kept.get(kept.size() - 1)).isEqualTo("20 next");
        }
    }

    @Test
    void leavesNumbersOutWhenTold() throws Exception {
        try (Journal journal = open(SMALL)) {
            append(journal, "a");
        }
        try (Journal journal = open(SMALL)) {
            journal.skipTo(500);
            assertThat(journal.end()).isEqualTo(500);
            JournalReader reader = journal.reader(500);
            append(journal, "b");
            assertThat(read(reader)).containsExactly("500 b");
            assertThatThrownBy(() -> journal.skipTo(600)).isInstanceOf(IllegalStateException.class);
        }
        try (Journal journal = open(SMALL)) {
            assertThat(read(journal.reader(0))).containsExactly("0 a", "500 b");
            assertThat(journal.damages()).isEmpty();
        }
    }

    @Test
    void takesNothingAfterItWasClosed() throws Exception {
        Journal journal = open(SMALL);
        CompletableFuture<Void> last = journal.append(payloads("last")).orElseThrow();
        journal.close();
        journal.close();

        assertThat(last).isCompleted();
        assertThat(journal.append(payloads("late")).orElseThrow())
                .failsWithin(Duration.ZERO)
                .withThrowableOfType(java.util.concurrent.ExecutionException.class)
                .withCauseInstanceOf(JournalException.Closed.class);
    }

    private Journal open(JournalSettings settings) {
        return Journal.open(folder, settings).orElseThrow();
    }

    static void append(Journal journal, String... texts) throws Exception {
        journal.append(payloads(texts)).orElseThrow().get(60, TimeUnit.SECONDS);
    }

    private static boolean tryAppend(Journal journal, String text) throws Exception {
        var durable = journal.append(payloads(text));
        if (durable.isPresent()) {
            durable.get().get(60, TimeUnit.SECONDS);
        }
        return durable.isPresent();
    }

    static List<byte[]> payloads(String... texts) {
        return Stream.of(texts).map(text -> text.getBytes(UTF_8)).toList();
    }

    static List<String> read(JournalReader reader) throws InterruptedException {
        return reader.read(100_000, Long.MAX_VALUE, Duration.ZERO).stream()
                .map(record -> record.sequence() + " " + new String(record.payload(), UTF_8))
                .toList();
    }

    private List<Path> segmentFiles() throws IOException {
        return Folders.list(folder).stream()
                .filter(file -> file.toString().endsWith(".segment"))
                .toList();
    }
}
