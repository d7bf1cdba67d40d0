package io.furrow.ingest.image;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;
import java.util.function.BooleanSupplier;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.streaming.util.KeyedOneInputStreamOperatorTestHarness;
import org.awaitility.Awaitility;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.files.Folders;
import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.route.ReportedEvent;

import static org.assertj.core.api.Assertions.assertThat;

/** The operator alone on a store with a gate, closed after each test. */
abstract class MoveImagesHarness {
    static final long T = Pictures.TIME;

    @TempDir
    Path folder;

    GatedStore.Gate gate;
    KeyedOneInputStreamOperatorTestHarness<String, ReportedEvent, ReportedEvent> harness;

    @BeforeEach
    void open() throws Exception {
        gate = GatedStore.below(folder);
        use(harness(1 << 20, 4, 1, 0));
    }

    void use(KeyedOneInputStreamOperatorTestHarness<String, ReportedEvent, ReportedEvent> other) throws Exception {
        if (harness != null) {
            harness.close();
        }
        harness = other;
        harness.open();
    }

    /** Waits for the threads of failed operators, which may still write to the folder. */
    @AfterEach
    void close() throws Exception {
        gate.open();
        if (harness != null) {
            harness.close();
        }
        Awaitility.await()
                .until(() -> Thread.getAllStackTraces().keySet().stream()
                        .noneMatch(thread -> thread.getName().equals("images")));
    }

    /** As a failure does: without waiting for what is under way. */
    void fail() throws Exception {
        harness.getOperator().close();
        harness = null;
    }

    KeyedOneInputStreamOperatorTestHarness<String, ReportedEvent, ReportedEvent> harness(
            long inFlight, int threads, int parallelism, int subtask) throws Exception {
        ImageSettings settings = new ImageSettings(
                GatedStore.uri(folder),
                Set.of("Image"),
                100_000,
                threads,
                inFlight,
                Duration.ofSeconds(1),
                StorageMode.ALL);
        return new KeyedOneInputStreamOperatorTestHarness<>(
                ImageStage.operator(settings, TypeInformation.of(ReportedEvent.class)),
                ReportedEvent::identity,
                Types.STRING,
                720,
                parallelism,
                subtask);
    }

    void assertClean() {
        assertThat(harness.numKeyedStateEntries()).isZero();
        assertThat(((MoveImages) harness.getOperator()).isIdle()).isTrue();
    }

    List<ReportedEvent> emitted() {
        return harness.extractOutputValues();
    }

    List<String> order() {
        return harness.getOutput().stream()
                .map(one -> one instanceof Watermark mark
                        ? "mark " + (mark.getTimestamp() - T)
                        : ((StreamRecord<?>) one).getValue() instanceof ReportedEvent event ? event.entityId() : "?")
                .toList();
    }

    static List<TopicRecord> records(Iterable<StreamRecord<TopicRecord>> output) {
        List<TopicRecord> records = new ArrayList<>();
        output.forEach(record -> records.add(record.getValue()));
        return records;
    }

    List<String> files() throws IOException {
        return Folders.walk(folder).stream()
                .filter(Files::isRegularFile)
                .map(file -> folder.relativize(file).toString())
                .toList();
    }

    /** The harness has no thread of its own: the mails of the store's threads are opened here. */
    void await(BooleanSupplier condition) throws Exception {
        long end = System.nanoTime() + Duration.ofSeconds(60).toNanos();
        while (!condition.getAsBoolean()) {
            assertThat(System.nanoTime()).as("still waiting").isLessThan(end);
            harness.getTaskMailbox()
                    .tryTake(0)
                    .ifPresentOrElse(
                            mail -> {
                                try {
                                    mail.run();
                                } catch (Exception e) {
                                    throw new IllegalStateException(e);
                                }
                            },
                            Thread::onSpinWait);
        }
    }
}
