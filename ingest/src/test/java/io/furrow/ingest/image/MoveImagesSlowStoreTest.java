package io.furrow.ingest.image;

import java.lang.ref.WeakReference;
import java.util.ArrayList;
import java.util.List;

import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.streaming.util.AbstractStreamOperatorTestHarness;
import org.junit.jupiter.api.Test;

import io.furrow.ingest.route.ReportedEvent;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** A store that is slow, away or hangs. */
class MoveImagesSlowStoreTest extends MoveImagesHarness {
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
            harness = harness(1 << 20, 4, 2, subtask);
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

        assertThat(files()).containsExactly("~tenant-farm/north/weeding/c1/c1_20231114221320123.png");
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
        await(() -> harness.getProcessingTimeService().getNumActiveTimers() == 1);

        assertThatThrownBy(() -> harness.setProcessingTime(60_000 + 1_000 + 1))
                .hasStackTraceContaining("the store does not answer");
        fail();
    }

    @Test
    void blamesTheStoreForNoImageThatWaitsForAThread() throws Exception {
        use(harness(1 << 20, 1, 1, 0));
        gate.close("/c");
        harness.processElement(Pictures.camera("c1", T, Pictures.png(1)), T);
        harness.processElement(Pictures.camera("c2", T, Pictures.png(2)), T);
        await(() -> harness.getProcessingTimeService().getNumActiveTimers() == 1);

        harness.setProcessingTime(60_000);
        gate.close("/c2");
        await(() -> emitted().size() == 1 && harness.getProcessingTimeService().getNumActiveTimers() == 1);
        harness.setProcessingTime(60_000 + 60_000);

        gate.open();
        await(() -> emitted().size() == 2);
        assertClean();
    }

    @Test
    void holdsNoImageThatHasPassedAnotherWhichHangs() throws Exception {
        gate.close("/c1");
        harness.processElement(Pictures.camera("c1", T, Pictures.png(1)), T);
        ReportedEvent event = Pictures.camera("c2", T + 1, Pictures.png(2));
        WeakReference<byte[]> image = new WeakReference<>(event.record().value());
        harness.processElement(event, T + 1);
        event = null;
        await(() -> emitted().size() == 1);

        await(() -> {
            System.gc();
            return image.refersTo(null);
        });
    }
}
