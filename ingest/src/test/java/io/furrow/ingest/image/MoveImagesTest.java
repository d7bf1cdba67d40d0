package io.furrow.ingest.image;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;
import java.util.function.BooleanSupplier;
import java.util.stream.Stream;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.streaming.util.AbstractStreamOperatorTestHarness;
import org.apache.flink.streaming.util.KeyedOneInputStreamOperatorTestHarness;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.flink.DeadLetters;
import io.furrow.flink.TopicRecord;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class MoveImagesTest {
    private static final long T = Pictures.TIME;

    @TempDir
    Path folder;

    private GatedStore.Gate gate;
    private KeyedOneInputStreamOperatorTestHarness<String, ReportedEvent, ReportedEvent> harness;

    @BeforeEach
    void open() throws Exception {
        gate = GatedStore.below(folder);
        harness = harness(1 << 20, 1, 0);
        harness.open();
    }

    @AfterEach
    void close() throws Exception {
        gate.open();
        if (harness != null) {
            harness.close();
        }
    }

    /** As a failure does: without waiting for what is under way. */
    private void fail() throws Exception {
        harness.getOperator().close();
        harness = null;
    }

    @Test
    void letsAnEventCarryAReferenceToItsImage() throws Exception {
        byte[] image = Pictures.png(1);
        ReportedEvent camera = Pictures.camera("c1", T, image);

        harness.processElement(camera, T);
        await(() -> emitted().size() == 1);

        Entity entity = Entity.parse(emitted().get(0).record().value());
        String file = "north/weeding/c1/c1_20231114221320123.png";
        assertThat(folder.resolve(file)).hasBinaryContent(image);
        assertThat(entity.value("Image").orElseThrow())
                .isEqualTo(NgsiJson.mapper()
                        .createObjectNode()
                        .put("url", "gated://" + folder + "/" + file)
                        .put("sha256", Sha256.hex(image))
                        .put("bytes", image.length)
                        .put("contentType", "image/png"));
        assertThat(emitted().get(0).record().headers())
                .isEqualTo(camera.record().headers());
        assertThat(records(harness.getSideOutput(ImageStage.MANIFEST)))
                .singleElement()
                .satisfies(manifest -> {
                    assertThat(manifest.topic()).isEqualTo("data.images");
                    assertThat(manifest.key()).asString().isEqualTo("c1");
                    assertThat(manifest.timestamp()).isEqualTo(T);
                    assertThat(NgsiJson.read(manifest.value()).toString())
                            .isEqualTo(
                                    "{\"entity\":\"c1\",\"attribute\":\"Image\",\"domain\":\"north\",\"mission\":\"weeding\","
                                            + "\"time\":\"2023-11-14T22:13:20.123Z\",\"url\":\"gated://" + folder + "/"
                                            + file + "\",\"sha256\":\"" + Sha256.hex(image) + "\",\"bytes\":"
                                            + image.length + ",\"contentType\":\"image/png\"}");
                });
        assertClean();
    }

    @Test
    void neverLetsABrokenImageBlockItsEvent() throws Exception {
        ReportedEvent broken = Pictures.event(
                "c1",
                T,
                Entity.builder("c1", "Camera").text("Image", "no picture!").number("Temperature", 3));

        harness.processElement(broken, T);
        await(() -> emitted().size() == 1);

        Entity entity = Entity.parse(emitted().get(0).record().value());
        assertThat(entity.json().path("Image").path("value").isNull()).isTrue();
        assertThat(entity.number("Temperature")).hasValue(3.0);
        assertThat(emitted().get(0).record().headers()).containsEntry("image-broken", "not-an-image");
        assertThat(records(harness.getSideOutput(DeadLetters.TAG)))
                .singleElement()
                .satisfies(dead -> {
                    assertThat(dead.topic()).isEqualTo("data.raw.dead");
                    assertThat(dead.value()).isEqualTo(broken.record().value());
                    assertThat(dead.headers())
                            .containsEntry(DeadLetter.REASON, "not-an-image")
                            .containsEntry(DeadLetter.STAGE, "ingest-images")
                            .containsEntry(DeadLetter.SOURCE, "data.raw-0@7");
                });
        assertThat(files()).isEmpty();
        assertClean();
    }

    @Test
    void refusesAnImageThatIsLargerThanAllowed() throws Exception {
        byte[] large = java.util.Arrays.copyOf(Pictures.png(1), 200_000);

        harness.processElement(Pictures.camera("c1", T, large), T);
        await(() -> emitted().size() == 1);

        assertThat(emitted().get(0).record().headers()).containsEntry("image-broken", "too-large");
    }

    @Test
    void letsOtherEntitiesPassWhileTheStoreIsSlow() throws Exception {
        gate.close("/c1");
        harness.processElement(Pictures.camera("c1", T, Pictures.png(1)), T);
        harness.processElement(Pictures.thermometer("t1", T + 1), T + 1);
        harness.processElement(Pictures.camera("c2", T + 2, Pictures.png(2)), T + 2);
        await(() -> emitted().size() == 2);

        assertThat(emitted()).extracting(ReportedEvent::entityId).containsExactly("t1", "c2");

        gate.open();
        await(() -> emitted().size() == 3);
        assertClean();
    }

    @Test
    void keepsTheOrderOfAnEntity() throws Exception {
        gate.close("/c1");
        for (int i = 0; i < 20; i++) {
            boolean withImage = i % 3 == 0;
            ReportedEvent event = withImage
                    ? Pictures.camera("c1", T + i, i % 2 == 0 ? Pictures.png(i) : Pictures.jpeg(i))
                    : Pictures.thermometer("c1", T + i);
            harness.processElement(event, T + i);
        }
        assertThat(emitted()).isEmpty();

        gate.open();
        await(() -> emitted().size() == 20);

        assertThat(emitted()).extracting(ReportedEvent::time).isSorted().doesNotHaveDuplicates();
        assertThat(files()).hasSize(7);
        assertClean();
    }

    @Test
    void holdsAWatermarkUntilTheEventsBeforeItHaveGoneOn() throws Exception {
        gate.close("/c1");
        harness.processWatermark(T - 1);
        harness.processElement(Pictures.camera("c1", T, Pictures.png(1)), T);
        harness.processWatermark(T);
        harness.processElement(Pictures.thermometer("t1", T + 5), T + 5);
        harness.processWatermark(T + 4);

        assertThat(order()).containsExactly("mark -1", "t1");

        gate.open();
        await(() -> order().size() == 5);
        assertThat(order()).containsExactly("mark -1", "t1", "c1", "mark 0", "mark 4");
    }

    @Test
    void goesOnWithTheSameEventsAfterAFailure() throws Exception {
        gate.close("/c");
        harness.processElement(Pictures.camera("c1", T, Pictures.png(1)), T);
        harness.processElement(Pictures.thermometer("c1", T + 1), T + 1);
        harness.processElement(Pictures.camera("c2", T + 2, Pictures.png(2)), T + 2);
        OperatorSubtaskState state = harness.snapshot(1, 1);
        fail();
        gate.open();

        List<String> events = new ArrayList<>();
        for (int subtask = 0; subtask < 2; subtask++) { // and at another parallelism
            harness = harness(1 << 20, 2, subtask);
            harness.initializeState(
                    AbstractStreamOperatorTestHarness.repartitionOperatorState(state, 720, 1, 2, subtask));
            harness.open();
            await(() -> harness.getOperator() instanceof MoveImages operator && operator.isIdle());
            emitted().forEach(event -> events.add(event.id()));
            assertClean();
            harness.close();
            harness = null;
        }
        assertThat(events).containsExactlyInAnyOrder("c1@" + T, "c1@" + (T + 1), "c2@" + (T + 2));
        assertThat(events.indexOf("c1@" + T)).isLessThan(events.indexOf("c1@" + (T + 1)));
        assertThat(files()).hasSize(2);
    }

    @Test
    void forgetsWhatACheckpointHeldWhenItHasGoneOn() throws Exception {
        gate.close("/c1");
        harness.processElement(Pictures.camera("c1", T, Pictures.png(1)), T);
        harness.snapshot(1, 1);
        assertThat(harness.numKeyedStateEntries()).isEqualTo(1);

        gate.open();
        await(() -> emitted().size() == 1);

        assertClean();
    }

    @Test
    void triesAgainWhileTheStoreIsAwayForAMoment() throws Exception {
        gate.failures.set(2);

        harness.processElement(Pictures.camera("c1", T, Pictures.png(1)), T);
        await(() -> emitted().size() == 1);

        assertThat(files()).containsExactly("north/weeding/c1/c1_20231114221320123.png");
    }

    @Test
    void failsWhenTheStoreStaysAway() throws Exception {
        gate.failures.set(1_000);

        harness.processElement(Pictures.camera("c1", T, Pictures.png(1)), T);

        assertThatThrownBy(() -> await(() -> emitted().size() == 1))
                .hasStackTraceContaining("the image of farm|/|c1 at data.raw-0@7 could not be stored")
                .hasStackTraceContaining("the store is away");
        assertThat(emitted()).isEmpty();
        fail();
    }

    @Test
    void failsWhenTheStoreHangs() throws Exception {
        gate.close("/c1");
        harness.processElement(Pictures.camera("c1", T, Pictures.png(1)), T);

        assertThatThrownBy(() -> harness.setProcessingTime(60_000 + 1_000 + 1))
                .hasStackTraceContaining("the store does not answer");
        fail();
    }

    @Test
    void takesNoMoreThanItMayHold() throws Exception {
        harness.close();
        harness = harness(4_000, 1, 0);
        harness.open();
        for (int i = 0; i < 50; i++) { // each about 2 kB: the operator must let go before it takes another
            harness.processElement(Pictures.camera("c" + i, T, Pictures.png(i)), T);
            assertThat(((MoveImages) harness.getOperator()).bytesInFlight()).isLessThanOrEqualTo(4_000);
        }
        harness.endInput();
        harness.getOperator().finish();

        assertThat(emitted()).hasSize(50);
    }

    @Test
    void waitsAtTheEndForWhatIsUnderWay() throws Exception {
        harness.processElement(Pictures.camera("c1", T, Pictures.png(1)), T);

        harness.getOperator().finish();

        assertThat(emitted()).hasSize(1);
    }

    private KeyedOneInputStreamOperatorTestHarness<String, ReportedEvent, ReportedEvent> harness(
            long inFlight, int parallelism, int subtask) throws Exception {
        ImageSettings settings =
                new ImageSettings(GatedStore.uri(folder), Set.of("Image"), 100_000, 4, inFlight, Duration.ofSeconds(1));
        return new KeyedOneInputStreamOperatorTestHarness<>(
                ImageStage.operator(settings, TypeInformation.of(ReportedEvent.class)),
                ReportedEvent::identity,
                Types.STRING,
                720,
                parallelism,
                subtask);
    }

    private void assertClean() {
        assertThat(harness.numKeyedStateEntries()).isZero();
        assertThat(((MoveImages) harness.getOperator()).isIdle()).isTrue();
    }

    private List<ReportedEvent> emitted() {
        return harness.extractOutputValues();
    }

    private List<String> order() {
        return harness.getOutput().stream()
                .map(one -> one instanceof Watermark mark
                        ? "mark " + (mark.getTimestamp() - T)
                        : ((StreamRecord<?>) one).getValue() instanceof ReportedEvent event ? event.entityId() : "?")
                .toList();
    }

    private static List<TopicRecord> records(Iterable<StreamRecord<TopicRecord>> output) {
        List<TopicRecord> records = new ArrayList<>();
        output.forEach(record -> records.add(record.getValue()));
        return records;
    }

    private List<String> files() throws IOException {
        try (Stream<Path> all = Files.walk(folder)) {
            return all.filter(Files::isRegularFile)
                    .map(file -> folder.relativize(file).toString())
                    .toList();
        }
    }

    /** The harness has no thread of its own: the mails of the store's threads are opened here. */
    private void await(BooleanSupplier condition) throws Exception {
        long end = System.nanoTime() + Duration.ofSeconds(20).toNanos();
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
