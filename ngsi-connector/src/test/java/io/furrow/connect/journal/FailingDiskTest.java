package io.furrow.connect.journal;

import java.time.Duration;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;

import org.junit.jupiter.api.Test;

import static io.furrow.connect.journal.JournalTest.append;
import static io.furrow.connect.journal.JournalTest.payloads;
import static io.furrow.connect.journal.JournalTest.read;
import static org.assertj.core.api.Assertions.assertThat;

class FailingDiskTest extends QuietJournal {
    private static final JournalSettings SMALL = new JournalSettings(1024 * 1024, 4 * 1024, 64 * 1024, 10_000);

    private final StubbornDisk disk = new StubbornDisk();

    @Test
    void confirmsNothingThatCouldNotBeSyncedAndGoesOnInANewFile() throws Exception {
        try (Journal journal = open()) {
            append(journal, "before");
            disk.failSyncs("Input/output error");
            assertFails(journal, "unconfirmed", JournalException.DiskFailed.class);
            disk.failSyncs(null);
            int syncs = disk.syncs();
            append(journal, "after");

            assertThat(disk.syncs() - syncs)
                    .as("the failed file is not synced again")
                    .isEqualTo(1);
            assertThat(read(journal.reader(0))).containsExactly("0 before", "2 after");
            assertThat(journal.reader(0).left()).isEqualTo(2);
            assertThat(segments()).hasSize(2);
        }
        try (Journal journal = open()) {
            assertThat(read(journal.reader(0))).containsExactly("0 before", "2 after");
            assertThat(journal.damages()).isEmpty();
        }
    }

    @Test
    void confirmsNothingThatCouldNotBeWritten() throws Exception {
        try (Journal journal = open()) {
            disk.failWrites("Input/output error");
            assertFails(journal, "never", JournalException.DiskFailed.class);
            disk.failWrites(null);
            append(journal, "after");
            assertThat(read(journal.reader(0))).containsExactly("1 after");
        }
        try (Journal journal = open()) {
            assertThat(read(journal.reader(0))).containsExactly("1 after");
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
            assertThat(journal.append(payloads("still full"))).isEmpty();
            assertThat(journal.failure()).isEmpty();

            disk.failCreation(null);
            disk.usable(Long.MAX_VALUE);
            append(journal, "after");
            assertThat(read(journal.reader(0))).containsExactly("0 after");
        }
    }

    @Test
    void givesUpWhenTheDiskFailsAgainAndAgain() throws Exception {
        try (Journal journal = open()) {
            append(journal, "good");
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
            assertThat(read(journal.reader(0))).containsExactly("0 good");
        }
    }

    @Test
    void survivesFailuresApartFromEachOther() throws Exception {
        try (Journal journal = open()) {
            for (int i = 0; i < 5; i++) {
                disk.failSyncs("Input/output error");
                assertFails(journal, "bad", JournalException.DiskFailed.class);
                disk.failSyncs(null);
                append(journal, "good");
            }
            assertThat(journal.failure()).isEmpty();
            assertThat(read(journal.reader(0))).hasSize(5).allMatch(record -> record.endsWith("good"));
        }
    }

    @Test
    void keepsNothingOfAnAppendThatDoesNotFitWhenItsNewFileCannotBeMade() throws Exception {
        try (Journal journal = open()) {
            append(journal, "before");
            disk.failCreation("Input/output error");
            String large = "x".repeat(1500);
            assertFails(journal, List.of(large, large, large), JournalException.DiskFailed.class);
            disk.failCreation(null);

            append(journal, "after");
            assertThat(read(journal.reader(0))).hasSize(2).first().isEqualTo("0 before");
            assertThat(journal.reader(0).left()).isEqualTo(2);
        }
    }

    @Test
    void confirmsWhatIsDurableOfAGroupThatFails() throws Exception {
        try (Journal journal = open()) {
            append(journal, "before");
            disk.holdSyncs();
            CompletableFuture<Void> held = begin(journal, "held");
            disk.awaitHeldSync();
            CompletableFuture<Void> fits = begin(journal, "fits");
            CompletableFuture<Void> doesNotFit = begin(journal, "x".repeat(4000));
            disk.failCreation("Input/output error");
            disk.letSyncsGo();

            assertThat(held).succeedsWithin(Duration.ofMinutes(1));
            assertThat(fits).as("it is on the disk").succeedsWithin(Duration.ofMinutes(1));
            assertThat(doesNotFit).failsWithin(Duration.ofMinutes(1));
            assertThat(read(journal.reader(0))).containsExactly("0 before", "1 held", "2 fits");
        }
    }

    @Test
    void goesOnWhenTheNextFileCannotBeMadeAhead() throws Exception {
        disk.failPreparation(true);
        try (Journal journal = open()) {
            append(journal, "first");
            assertThat(begin(journal, "second")).succeedsWithin(Duration.ofMinutes(1));
        }
    }

    private static CompletableFuture<Void> begin(Journal journal, String text) {
        return journal.append(payloads(text)).orElseThrow();
    }

    private Journal open() {
        return Journal.open(folder, SMALL, disk).orElseThrow();
    }

    private static void assertFails(Journal journal, String text, Class<? extends Throwable> kind) {
        assertFails(journal, List.of(text), kind);
    }

    private static void assertFails(Journal journal, List<String> texts, Class<? extends Throwable> kind) {
        CompletableFuture<Void> durable =
                journal.append(payloads(texts.toArray(String[]::new))).orElseThrow();
        assertThat(durable)
                .failsWithin(Duration.ofMinutes(1))
                .withThrowableOfType(ExecutionException.class)
                .withCauseInstanceOf(kind);
    }
}
