package io.furrow.connect.source.journal;

import java.nio.file.Path;
import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.Map;
import java.util.OptionalLong;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.AtomicInteger;

import org.apache.kafka.connect.errors.ConnectException;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.connect.journal.JournalFolders;
import io.furrow.connect.journal.JournalRecord;
import io.furrow.connect.journal.JournalSettings;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.record.KafkaRecord;
import io.furrow.connect.source.NgsiSourceConnector;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatCode;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class TaskJournalsTest {
    private final Map<String, Long> offsets = new ConcurrentHashMap<>();
    private final Ledger ledger = new Ledger();
    private final AtomicInteger failures = new AtomicInteger();
    private Runnable whenAsked = () -> {};
    private TaskJournals.Safety safety = TaskJournals.Safety.NONE;

    @TempDir
    private Path root;

    @Test
    void goesOnWhereTheOffsetSaysAndFromTheOldestAfterAReset() throws Exception {
        String id;
        try (TaskJournals journals = open(0)) {
            id = journals.own().id();
            take(journals, 5);
            assertThat(numbers(journals)).containsExactly(0L, 1L, 2L, 3L, 4L);
        }
        offsets.put(id, 3L);
        try (TaskJournals journals = open(0)) {
            assertThat(numbers(journals)).containsExactly(3L, 4L);
        }
        offsets.remove(id);
        try (TaskJournals journals = open(0)) {
            assertThat(numbers(journals)).containsExactly(0L, 1L, 2L, 3L, 4L);
        }
        offsets.put(id, 1000L);
        try (TaskJournals journals = open(0)) {
            assertThat(numbers(journals)).isEmpty();
            take(journals, 1);
            assertThat(numbers(journals)).containsExactly(1000L);
        }
    }

    @Test
    void drainsTheJournalOfAnotherTaskAndDeletesItWhenKafkaHasIt() throws Exception {
        Path left = left(3);
        String id = left.getFileName().toString();
        try (TaskJournals journals = open(0)) {
            journals.adopt();
            assertThat(ledger.recovered.sum()).isEqualTo(3);
            assertThat(numbers(journals)).containsExactly(0L, 1L, 2L);
            journals.release();
            assertThat(left).as("Kafka does not have it yet").exists();
            offsets.put(id, 3L);
            journals.release();
            assertThat(left).doesNotExist();
        }
    }

    @Test
    void takesOverAllThatIsLeftAfterTheOffsetStoreFailedOnce() throws Exception {
        for (int slot = 1; slot <= 2; slot++) {
            try (TaskJournals gone = open(slot)) {
                take(gone, 1);
            }
        }
        try (TaskJournals journals = open(0)) {
            failures.set(1);
            assertThatThrownBy(journals::adopt).isInstanceOf(ConnectException.class);

            journals.adopt();

            assertThat(numbers(journals)).containsExactly(0L, 0L);
        }
        try (TaskJournals journals = open(0)) {
            journals.adopt();
            assertThat(numbers(journals)).as("nothing stayed locked").containsExactly(0L, 0L);
        }
    }

    @Test
    void takesOverNothingAfterItWasClosed() {
        left(1);
        TaskJournals journals = open(0);
        whenAsked = journals::close;
        journals.adopt();

        whenAsked = () -> {};
        try (TaskJournals next = open(1)) {
            assertThat(next.own().end()).as("the journal is free").isEqualTo(1);
        }
    }

    @Test
    void deletesNothingAfterItWasClosed() {
        Path left = left(1);
        TaskJournals journals = open(0);
        journals.adopt();
        offsets.put(left.getFileName().toString(), 1L);
        whenAsked = journals::close;

        journals.release();

        assertThat(left).as("it may be another task's by now").exists();
    }

    @Test
    void freesWhatWasSkippedBehindWhatKafkaHas() throws Exception {
        Path left = left(3);
        String id = left.getFileName().toString();
        offsets.put(id, 1L);
        try (TaskJournals journals = open(0)) {
            journals.adopt();
            numbers(journals);
            journals.skipped(id, 2);
            journals.release();
            assertThat(left).exists();
            journals.skipped(id, 1);
            journals.release();
            assertThat(left).doesNotExist();
        }
    }

    @Test
    void handsOnAgainWhatKafkaMissedWhenAnotherTaskResumesIt() throws Exception {
        try (TaskJournals journals = open(0)) {
            take(journals, 4);
            numbers(journals);
            journals.resume(journal -> OptionalLong.of(2));
            assertThat(ledger.produced.sum()).isEqualTo(2);
            assertThat(ledger.recovered.sum()).isZero();
            assertThat(numbers(journals)).containsExactly(2L, 3L);
        }
    }

    @Test
    void keepsWhatKafkaIsNotKnownToHave() throws Exception {
        String id;
        try (TaskJournals journals = open(0)) {
            id = journals.own().id();
            KafkaRecord large = new KafkaRecord("raw", "key", new byte[3_000_000], Instant.EPOCH, Map.of());
            for (int i = 0; i < 4; i++) {
                new JournalRecordLog(journals.own(), ledger)
                        .take(List.of(large))
                        .orElseThrow()
                        .join();
            }
            assertThat(numbers(journals)).hasSize(4);
            long bytes = journals.own().bytes();
            journals.release();
            assertThat(journals.own().bytes()).isEqualTo(bytes);
            assertThat(journals.own().begin()).isZero();
            offsets.put(id, 3L);
            journals.release();
            assertThat(journals.own().begin()).isBetween(1L, 3L);
        }
    }

    @Test
    void handsOnAgainWhatKafkaLostAndKeepsItUntilKafkaHasItOnceMore() throws Exception {
        Path left = left(4);
        String id = left.getFileName().toString();
        offsets.put(id, 4L);
        safety = new TaskJournals.Safety(Duration.ZERO, (journal, committed) -> Math.min(committed, 2));
        try (TaskJournals journals = open(0)) {
            journals.adopt();
            assertThat(ledger.recovered.sum()).isEqualTo(2);
            assertThat(numbers(journals)).containsExactly(2L, 3L);
            journals.release();
            assertThat(left).as("the offset store says what it said before").exists();
            offsets.put(id, 3L);
            journals.release();
            assertThat(left).exists();
            offsets.put(id, 4L);
            journals.release();
            assertThat(left).doesNotExist();
        }
    }

    /** Or though its offset is after its end, which a power cut took. */
    @ParameterizedTest
    @ValueSource(longs = {1_000_000_000_001L, 1_000_000_000_005L})
    void deletesAJournalOfWhichKafkaHasTheLostRecordsAgainThoughItsOffsetIsTheSame(long offset) throws Exception {
        Path left = left(2);
        String id = left.getFileName().toString();
        offsets.put(id, 1_000_000_000_000L);
        left(1);
        offsets.put(id, offset);
        safety = new TaskJournals.Safety(Duration.ZERO, (journal, committed) -> 0);
        try (TaskJournals journals = open(0)) {
            journals.adopt();
            assertThat(numbers(journals)).containsExactly(0L, 1L, 1_000_000_000_000L);
            journals.produced(id, 1_000_000_000_000L);
            journals.skipped(id, 1);
            journals.release();
            assertThat(left).as("Kafka does not have record 0 yet").exists();
            journals.produced(id, 0);
            journals.release();
            assertThat(left).doesNotExist();
        }
    }

    @Test
    void keepsForAWhileWhatKafkaHas() throws Exception {
        Path left = left(1);
        safety = new TaskJournals.Safety(Duration.ofHours(1), TaskJournals.Verification.NONE);
        try (TaskJournals journals = open(0)) {
            journals.adopt();
            numbers(journals);
            offsets.put(left.getFileName().toString(), 1L);
            journals.release();
            assertThat(left).exists();
        }
    }

    @Test
    void takesOffsetsOfItsShapeOnly() {
        NgsiSourceConnector connector = new NgsiSourceConnector();
        Map<String, ?> partition = Map.of("journal", "0-0123456789abcdef");
        assertThat(connector.alterOffsets(Map.of(), Map.of(partition, Map.of("record", 7))))
                .isTrue();
        Map<Map<String, ?>, Map<String, ?>> reset = new java.util.HashMap<>();
        reset.put(partition, null);
        assertThatCode(() -> connector.alterOffsets(Map.of(), reset)).doesNotThrowAnyException();

        for (Map<String, ?> wrong : List.of(Map.of("record", -1), Map.of("record", "7"), Map.of("position", 7))) {
            assertThatThrownBy(() -> connector.alterOffsets(Map.of(), Map.of(partition, wrong)))
                    .isInstanceOf(ConnectException.class)
                    .hasMessageContaining("{\"record\": n}");
        }
        assertThatThrownBy(() -> connector.alterOffsets(Map.of(), Map.of(Map.of("file", "a"), Map.of("record", 7))))
                .isInstanceOf(ConnectException.class)
                .hasMessageContaining("{\"journal\": \"<id>\"}");
    }

    private TaskJournals open(int slot) {
        JournalSettings settings = JournalSettings.of(64 * 1024 * 1024, 1024 * 1024, 0);
        return new TaskJournals(new JournalFolders(root, "farm", settings), slot, this::committed, safety, ledger);
    }

    /** The folder of a journal with so many records, whose name is its id, of a task that is no more. */
    private Path left(int records) {
        try (TaskJournals gone = open(1)) {
            take(gone, records);
            return gone.own().folder();
        }
    }

    private OptionalLong committed(String journal) {
        if (failures.getAndUpdate(left -> Math.max(0, left - 1)) > 0) {
            throw new ConnectException("no answer");
        }
        whenAsked.run();
        Long offset = offsets.get(journal);
        return offset == null ? OptionalLong.empty() : OptionalLong.of(offset);
    }

    private void take(TaskJournals journals, int records) {
        KafkaRecord record = new KafkaRecord("raw", "key", new byte[10], Instant.EPOCH, Map.of());
        for (int i = 0; i < records; i++) {
            new JournalRecordLog(journals.own(), ledger)
                    .take(List.of(record))
                    .orElseThrow()
                    .join();
        }
    }

    private static List<Long> numbers(TaskJournals journals) throws InterruptedException {
        List<Long> numbers = new java.util.ArrayList<>();
        for (int turn = 0; turn < 4; turn++) {
            journals.next(100, Duration.ZERO).records().stream()
                    .map(JournalRecord::sequence)
                    .forEach(numbers::add);
        }
        return numbers;
    }
}
