package io.furrow.connect.journal;

import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;

import org.apache.logging.log4j.Level;
import org.apache.logging.log4j.core.config.Configurator;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

class FailingDiskTest {
    private static final JournalSettings SMALL = new JournalSettings(1024 * 1024, 4 * 1024, 64 * 1024, 10_000);

    private final StubbornDisk disk = new StubbornDisk();

    private Path folder;

    /** Each damage is a line in the log. */
    @BeforeAll
    static void keepQuiet() {
        Configurator.setLevel("io.furrow.connect.journal", Level.OFF);
    }

    @AfterAll
    static void speakAgain() {
        Configurator.setLevel("io.furrow.connect.journal", Level.ERROR);
    }

    @BeforeEach
    void makeFolder(@TempDir Path parent) throws Exception {
        folder = Files.createDirectory(parent.resolve("0-journal"));
    }

    @Test
    void confirmsNothingThatCouldNotBeSyncedAndGoesOnInANewFile() throws Exception {
        try (Journal journal = open()) {
            JournalTest.append(journal, "before");
            disk.failSyncs("Input/output error");
            assertFails(journal, "unconfirmed", JournalException.DiskFailed.class);
            disk.failSyncs(null);
            int syncs = disk.syncs();
            JournalTest.append(journal, "after");

            assertThat(disk.syncs() - syncs)
                    .as("the failed file is not synced again")
                    .isEqualTo(1);
            assertThat(JournalTest.read(journal.reader(0))).containsExactly("0 before", "2 after");
            assertThat(journal.reader(0).left()).isEqualTo(2);
            assertThat(segmentFiles()).isEqualTo(2);
        }
        try (Journal journal = open()) {
            assertThat(JournalTest.read(journal.reader(0))).containsExactly("0 before", "2 after");
            assertThat(journal.damages()).isEmpty();
        }
    }

    @Test
    void confirmsNothingThatCouldNotBeWritten() throws Exception {
        try (Journal journal = open()) {
            disk.failWrites("Input/output error");
            assertFails(journal, "never", JournalException.DiskFailed.class);
            disk.failWrites(null);
            JournalTest.append(journal, "after");
            assertThat(JournalTest.read(journal.reader(0))).containsExactly("1 after");
        }
        try (Journal journal = open()) {
            assertThat(JournalTest.read(journal.reader(0))).containsExactly("1 after");
            assertThat(journal.lostRecords()).isZero();
        }
    }

    @Test
    void hasNoRoomWhileTheDiskIsFullAndGoesOnAfterwards() throws Exception {
        try (Journal journal = open()) {
            disk.failCreation("No space left on device");
            for (int i = 0; i < 4; i++) {
                disk.usableAfterTheNextQuestion(0);
                assertFails(journal, "full", JournalException.NoRoom.class);
            }
            assertThat(journal.append(JournalTest.payloads("still full"))).isEmpty();
            assertThat(journal.failure()).isEmpty();

            disk.failCreation(null);
            disk.usable(Long.MAX_VALUE);
            JournalTest.append(journal, "after");
            assertThat(JournalTest.read(journal.reader(0))).containsExactly("0 after");
        }
    }

    @Test
    void givesUpWhenTheDiskFailsAgainAndAgain() throws Exception {
        try (Journal journal = open()) {
            JournalTest.append(journal, "good");
            disk.failWrites("Input/output error");
            for (int i = 0; i < 3; i++) {
                assertThat(journal.failure()).isEmpty();
                assertFails(journal, "bad", JournalException.DiskFailed.class);
            }
            disk.failWrites(null);

            assertThat(journal.failure())
                    .get()
                    .extracting(Throwable::getMessage)
                    .isEqualTo("Input/output error");
            assertFails(journal, "too late", JournalException.DiskFailed.class);
            assertThat(JournalTest.read(journal.reader(0))).containsExactly("0 good");
        }
    }

    @Test
    void survivesFailuresApartFromEachOther() throws Exception {
        try (Journal journal = open()) {
            for (int i = 0; i < 5; i++) {
                disk.failSyncs("Input/output error");
                assertFails(journal, "bad", JournalException.DiskFailed.class);
                disk.failSyncs(null);
                JournalTest.append(journal, "good");
            }
            assertThat(journal.failure()).isEmpty();
            assertThat(JournalTest.read(journal.reader(0))).hasSize(5).allMatch(record -> record.endsWith("good"));
        }
    }

    @Test
    void keepsNothingOfAnAppendThatDoesNotFitWhenItsNewFileCannotBeMade() throws Exception {
        try (Journal journal = open()) {
            JournalTest.append(journal, "before");
            disk.failCreation("Input/output error");
            String large = "x".repeat(1500);
            assertFails(journal, List.of(large, large, large), JournalException.DiskFailed.class);
            disk.failCreation(null);

            JournalTest.append(journal, "after");
            assertThat(JournalTest.read(journal.reader(0))).hasSize(2).first().isEqualTo("0 before");
            assertThat(journal.reader(0).left()).isEqualTo(2);
        }
    }

    @Test
    void confirmsWhatIsDurableOfAGroupThatFails() throws Exception {
        try (Journal journal = open()) {
            JournalTest.append(journal, "before");
            disk.holdSyncs();
            CompletableFuture<Void> held = append(journal, "held");
            disk.awaitHeldSync();
            CompletableFuture<Void> fits = append(journal, "fits");
            CompletableFuture<Void> doesNotFit = append(journal, "x".repeat(4000));
            disk.failCreation("Input/output error");
            disk.letSyncsGo();

            assertThat(held).succeedsWithin(Duration.ofMinutes(1));
            assertThat(fits).as("it is on the disk").succeedsWithin(Duration.ofMinutes(1));
            assertThat(doesNotFit).failsWithin(Duration.ofMinutes(1));
            assertThat(JournalTest.read(journal.reader(0))).containsExactly("0 before", "1 held", "2 fits");
        }
    }

    @Test
    void goesOnWhenTheNextFileCannotBeMadeAhead() throws Exception {
        disk.failPreparation(true);
        try (Journal journal = open()) {
            JournalTest.append(journal, "first");
            assertThat(append(journal, "second")).succeedsWithin(Duration.ofMinutes(1));
        }
    }

    private static CompletableFuture<Void> append(Journal journal, String text) {
        return journal.append(JournalTest.payloads(text)).orElseThrow();
    }

    private Journal open() {
        return Journal.open(folder, SMALL, disk).orElseThrow();
    }

    private static void assertFails(Journal journal, String text, Class<? extends Throwable> kind) {
        assertFails(journal, List.of(text), kind);
    }

    private static void assertFails(Journal journal, List<String> texts, Class<? extends Throwable> kind) {
        CompletableFuture<Void> durable = journal.append(JournalTest.payloads(texts.toArray(String[]::new)))
                .orElseThrow();
        assertThat(durable)
                .failsWithin(Duration.ofMinutes(1))
                .withThrowableOfType(ExecutionException.class)
                .withCauseInstanceOf(kind);
    }

    private long segmentFiles() throws Exception {
        try (var files = Files.list(folder)) {
            return files.filter(file -> file.toString().endsWith(".segment")).count();
        }
    }
}
