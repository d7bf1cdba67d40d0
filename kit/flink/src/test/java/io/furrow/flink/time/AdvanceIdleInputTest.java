package io.furrow.flink.time;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import org.apache.flink.configuration.Configuration;
import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.watermarkstatus.WatermarkStatus;
import org.apache.flink.streaming.util.AbstractStreamOperatorTestHarness;
import org.apache.flink.streaming.util.OneInputStreamOperatorTestHarness;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

import io.furrow.flink.job.JobEnvironment;

import static org.assertj.core.api.Assertions.assertThat;

/** The wall clock begins at 100 s; a subtask is idle when the test says so. */
class AdvanceIdleInputTest {
    private static final long CLOCK = 100_000;
    private static final int MAX_PARALLELISM = 16;

    private final List<OneInputStreamOperatorTestHarness<String, String>> opened = new ArrayList<>();
    private String maxAhead;

    @AfterEach
    void close() throws Exception {
        for (var each : opened) {
            each.close();
        }
    }

    @Test
    void leavesWatermarksAndIdlenessAsTheyAreWithoutARestart() throws Exception {
        var input = start(1, 0, null, CLOCK);
        input.processWatermarkStatus(WatermarkStatus.IDLE);
        input.setProcessingTime(CLOCK + 60_000);
        input.processWatermarkStatus(WatermarkStatus.ACTIVE);
        input.processWatermark(1_000);

        assertThat(input.getOutput())
                .containsExactly(WatermarkStatus.IDLE, WatermarkStatus.ACTIVE, new Watermark(1_000));
    }

    @Test
    void goesOnWithTheClockWhereNothingHasComeSinceARestart() throws Exception {
        var before = start(1, 0, null, CLOCK);
        before.processWatermark(50_000);

        var input = start(1, 0, snapshot(before), CLOCK + 30_000);
        assertThat(input.getOutput()).isEmpty();
        input.processWatermarkStatus(WatermarkStatus.IDLE);
        assertThat(watermarks(input)).containsExactly(50_000L);
        input.setProcessingTime(CLOCK + 31_000);
        assertThat(watermarks(input).get(watermarks(input).size() - 1)).isEqualTo(51_000L);
        assertThat(input.getOutput())
                .as("holds up nobody between two watermarks")
                .startsWith(WatermarkStatus.ACTIVE, new Watermark(50_000), WatermarkStatus.IDLE);

        var again = start(1, 0, snapshot(input), CLOCK + 60_000);
        again.processWatermarkStatus(WatermarkStatus.IDLE);
        assertThat(watermarks(again)).containsExactly(51_000L);
    }

    @Test
    void goesByTheInputAgainOnceSomethingComes() throws Exception {
        var before = start(1, 0, null, CLOCK);
        before.processWatermark(50_000);
        var input = start(1, 0, snapshot(before), CLOCK + 30_000);
        input.processWatermarkStatus(WatermarkStatus.IDLE);
        input.processWatermarkStatus(WatermarkStatus.ACTIVE);
        input.processElement("late", 45_000);
        input.processWatermark(45_000);
        input.setProcessingTime(CLOCK + 90_000);
        input.processWatermark(80_000);

        assertThat(watermarks(input)).containsExactly(50_000L, 80_000L);
        assertThat(input.extractOutputValues()).containsExactly("late");
    }

    @Test
    void goesByTheSlowestOfAllSubtasks() throws Exception {
        var fast = start(2, 0, null, CLOCK);
        var slow = start(2, 1, null, CLOCK);
        fast.processWatermark(50_000);
        slow.processWatermark(40_000);
        OperatorSubtaskState state =
                AbstractStreamOperatorTestHarness.repackageState(fast.snapshot(1, 1), slow.snapshot(1, 1));

        for (int index = 0; index < 3; index++) {
            var input = start(3, index, part(state, 2, 3, index), CLOCK + 30_000);
            input.processWatermarkStatus(WatermarkStatus.IDLE);
            assertThat(watermarks(input)).containsExactly(40_000L);
        }
    }

    @Test
    void goesByThoseWithRecordsBeforeThoseWithout() throws Exception {
        var first = start(2, 0, null, CLOCK);
        first.processWatermark(50_000);
        var none = start(2, 1, null, CLOCK);
        OperatorSubtaskState state =
                AbstractStreamOperatorTestHarness.repackageState(first.snapshot(1, 1), none.snapshot(1, 1));
        var fed = start(2, 0, part(state, 2, 2, 0), CLOCK);
        var quiet = start(2, 1, part(state, 2, 2, 1), CLOCK);
        fed.processWatermark(350_000);
        quiet.processWatermarkStatus(WatermarkStatus.IDLE);
        quiet.setProcessingTime(CLOCK + 1_000);
        OperatorSubtaskState later =
                AbstractStreamOperatorTestHarness.repackageState(fed.snapshot(2, 2), quiet.snapshot(2, 2));

        var again = start(1, 0, part(later, 2, 1, 0), CLOCK + 300_000);
        again.processWatermarkStatus(WatermarkStatus.IDLE);

        assertThat(watermarks(again)).containsExactly(350_000L);
    }

    @Test
    void waitsForRecordsIfTheClockWasAhead() throws Exception {
        var before = start(1, 0, null, CLOCK);
        before.processWatermark(System.currentTimeMillis() + 3_600_000);

        maxAhead = "PT10S";
        var input = start(1, 0, snapshot(before), CLOCK + 30_000);
        input.processWatermarkStatus(WatermarkStatus.IDLE);
        input.processWatermarkStatus(WatermarkStatus.ACTIVE);
        input.processWatermark(1_000);

        assertThat(watermarks(input)).containsExactly(1_000L);
    }

    private static List<Long> watermarks(OneInputStreamOperatorTestHarness<String, String> input) {
        return input.getOutput().stream()
                .filter(Watermark.class::isInstance)
                .map(each -> ((Watermark) each).getTimestamp())
                .toList();
    }

    private static OperatorSubtaskState snapshot(OneInputStreamOperatorTestHarness<String, String> input)
            throws Exception {
        return part(AbstractStreamOperatorTestHarness.repackageState(input.snapshot(1, 1)), 1, 1, 0);
    }

    private static OperatorSubtaskState part(OperatorSubtaskState state, int before, int now, int index) {
        return AbstractStreamOperatorTestHarness.repartitionOperatorState(state, MAX_PARALLELISM, before, now, index);
    }

    private OneInputStreamOperatorTestHarness<String, String> start(
            int parallelism, int index, OperatorSubtaskState state, long clock) throws Exception {
        var input = new OneInputStreamOperatorTestHarness<String, String>(
                new AdvanceIdleInput<>(), MAX_PARALLELISM, parallelism, index);
        if (maxAhead != null) {
            input.getExecutionConfig()
                    .setGlobalJobParameters(Configuration.fromMap(Map.of(JobEnvironment.MAX_RESTORED_AHEAD, maxAhead)));
        }
        opened.add(input);
        input.setProcessingTime(clock);
        if (state != null) {
            input.initializeState(state);
        }
        input.open();
        return input;
    }
}
