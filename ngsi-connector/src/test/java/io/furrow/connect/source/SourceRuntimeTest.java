package io.furrow.connect.source;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.OptionalLong;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.atomic.AtomicLong;

import org.apache.kafka.connect.errors.ConnectException;
import org.apache.kafka.connect.source.SourceRecord;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.connect.journal.Journal;
import io.furrow.connect.journal.JournalFolders;
import io.furrow.connect.journal.JournalSettings;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.source.journal.JournalMaintenance;
import io.furrow.connect.source.journal.TaskJournals;
import io.furrow.embedded.FreePort;
import io.furrow.process.Ports;

import static org.assertj.core.api.Assertions.assertThat;

class SourceRuntimeTest {
    private static final Duration LONG = Duration.ofMinutes(10);

    private final int port = FreePort.orFree(0);
    private final SourceOnConnect source = new SourceOnConnect(port);

    @TempDir
    private Path directory;

    @AfterEach
    void leaveNothingBehind() {
        SourceRuntime.attach(config(LONG)).ifPresent(SourceRuntime::close);
    }

    @Test
    void takesNotificationsWithoutATaskAndTheNextTaskWritesThemAll() throws Exception {
        SourceRuntime running = open(LONG);
        String journal = running.journals().own().id();
        source.take("with", 2);
        running.journals().next(10, Duration.ZERO);

        running.detach();
        source.take("without", 2);
        NgsiSourceTask next = task(Map.of(SourceOffsets.partition(journal), SourceOffsets.offsetOf(0)));
        next.start(options(LONG));
        try {
            source.take("again", 1);
            assertThat(keys(next, 4)).containsExactly("with-1", "without-0", "without-1", "again-0");
            assertThat(source.ledger("requests")).as("it is the same source").isEqualTo(5);
        } finally {
            next.stop();
        }
        assertThat(Ports.isListening(port)).as("Kafka was there").isFalse();
    }

    @Test
    void endsWhenNoTaskComesInTimeAndLeavesItsJournal() throws Exception {
        Duration timeout = Duration.ofSeconds(2); // within it the notification must be taken
        SourceRuntime running = open(timeout);
        running.detach();
        source.take("left", 1);

        source.awaitSilence();
        SourceOnConnect.await().until(this::isJournalFree);
        assertThat(SourceRuntime.attach(config(timeout))).isEmpty();
        NgsiSourceTask next = task(Map.of());
        next.start(options(timeout));
        try {
            assertThat(keys(next, 1)).containsExactly("left-0");
        } finally {
            next.stop();
        }
    }

    @Test
    void endsWhenTheNextTaskHasOtherOptions() {
        open(LONG).detach();

        Map<String, String> others = options(LONG);
        others.put("topic", "another");
        assertThat(SourceRuntime.attach(new NgsiSourceConfig(others))).isEmpty();
        assertThat(Ports.isListening(port)).isFalse();
        assertThat(isJournalFree()).isTrue();
    }

    @Test
    void isForATaskOfTheSameNumberOfTheSameConnector() {
        open(LONG).detach();

        Map<String, String> other = options(LONG);
        other.put("name", "another");
        assertThat(SourceRuntime.attach(new NgsiSourceConfig(other))).isEmpty();
        other = options(LONG);
        other.put(NgsiSourceConfig.TASK_INDEX, "1");
        other.put(NgsiSourceConfig.TASK_COUNT, "2");
        assertThat(SourceRuntime.attach(new NgsiSourceConfig(other))).isEmpty();
        assertThat(Ports.isListening(port)).isTrue();
    }

    @Tag("full")
    @Test
    void isNeededWhenTheOffsetStoreHasNotAnsweredFor2500Milliseconds() {
        for (long silence : List.of(2400L, 2600L)) {
            AtomicLong nanoTime = new AtomicLong();
            AtomicInteger asked = new AtomicInteger();
            AtomicBoolean away = new AtomicBoolean();
            try (TaskJournals journals = journals(away, asked)) {
                JournalMaintenance maintenance = JournalMaintenance.start(journals, true, nanoTime::get);
                nanoTime.addAndGet(Duration.ofMinutes(1).toNanos());
                SourceOnConnect.await().until(() -> asked.get() > 2);
                away.set(true);
                int before = asked.get();
                SourceOnConnect.await().until(() -> asked.get() > before);
                nanoTime.addAndGet(Duration.ofMillis(silence).toNanos());

                assertThat(maintenance.isKafkaUnavailable())
                        .as("after %d ms", silence)
                        .isEqualTo(silence > 2500);
                maintenance.close();
            }
        }
    }

    private TaskJournals journals(AtomicBoolean away, AtomicInteger asked) {
        JournalSettings settings = JournalSettings.of(64 * 1024 * 1024, 1024 * 1024, 0);
        TaskJournals.Committed committed = journal -> {
            asked.incrementAndGet();
            if (away.get()) {
                throw new ConnectException("no answer");
            }
            return OptionalLong.empty();
        };
        return new TaskJournals(
                new JournalFolders(directory, "kept", settings), 0, committed, TaskJournals.Safety.NONE, new Ledger());
    }

    private SourceRuntime open(Duration standby) {
        return SourceRuntime.open(config(standby), journal -> OptionalLong.empty());
    }

    private NgsiSourceTask task(Map<Map<String, ?>, Map<String, ?>> committed) {
        NgsiSourceTask task = new NgsiSourceTask();
        task.initialize(new StubContext(Map.of(), new HashMap<>(committed)));
        return task;
    }

    private static List<Object> keys(NgsiSourceTask task, int count) {
        List<Object> keys = new ArrayList<>();
        SourceOnConnect.await().until(() -> {
            List<SourceRecord> records = task.poll();
            if (records != null) {
                records.forEach(record -> keys.add(record.key()));
            }
            return keys.size() >= count;
        });
        return keys;
    }

    private boolean isJournalFree() {
        JournalSettings settings = JournalSettings.of(64 * 1024 * 1024, 1024 * 1024, 0);
        List<Journal> free = new ArrayList<>();
        new JournalFolders(directory, "farm", settings).adopt(free::add);
        free.forEach(Journal::close);
        return !free.isEmpty();
    }

    private NgsiSourceConfig config(Duration standby) {
        return new NgsiSourceConfig(options(standby));
    }

    private Map<String, String> options(Duration standby) {
        return new HashMap<>(Map.of(
                "name", "farm",
                "listen.port", Integer.toString(port),
                "journal.dir", directory.toString(),
                "journal.standby.ms", Long.toString(standby.toMillis()),
                "topic", "raw"));
    }
}
