package io.furrow.analytics.clock;

import java.time.Duration;
import java.util.List;

import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.streaming.api.operators.KeyedProcessOperator;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.util.KeyedOneInputStreamOperatorTestHarness;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

class DetectClockLagTest {
    private static final long MINUTE = 60_000;
    private static final long HOUR = 60 * MINUTE;
    private static final long NOTHING = Long.MIN_VALUE;

    private KeyedOneInputStreamOperatorTestHarness<String, LaggingPosition, ClockReport> harness;

    @BeforeEach
    void start() throws Exception {
        harness = new KeyedOneInputStreamOperatorTestHarness<>(
                new KeyedProcessOperator<>(new DetectClockLag(Duration.ofHours(1))),
                LaggingPosition::key,
                Types.STRING);
        harness.open();
    }

    @AfterEach
    void leaveNothing() throws Exception {
        harness.processWatermark(new Watermark(12 * HOUR));
        assertThat(harness.numKeyedStateEntries()).isZero();
        assertThat(harness.numEventTimeTimers()).isZero();
        harness.close();
    }

    @Test
    void reportsADeviceAfterTenLatePositionsWithinHalfAMinuteAndThenOnceAMinute() throws Exception {
        for (int second = 0; second < 200; second++) {
            late("r", 1000L * second, 700, NOTHING);
            late("other", 1000L * second, 700, 1000L * second - 1000);
            if (second == 50) {
                restart();
            }
        }
        assertThat(told())
                .extracting(ClockReport::id, ClockReport::time, ClockReport::millis, ClockReport::positions)
                .containsExactly(
                        tuple("r", 30_000L, 700L, 31), tuple("r", 90_000L, 700L, 91), tuple("r", 150_000L, 700L, 151));
    }

    @Test
    void reportsNoneThatSendsAtOnceWhatItStored() throws Exception {
        for (int second = 0; second < 600; second++) {
            late("r", 1_000_000 + second * 10, 600_000 - second * 1000, NOTHING);
        }
        assertThat(told()).isEmpty();
    }

    @Test
    void beginsAnewWherePositionsCountedInBetweenOrNoneCameForLong() throws Exception {
        for (int run = 0; run < 3; run++) {
            for (int second = 0; second < 29; second++) {
                long reached = run * 4 * HOUR + second * 1000;
                late("r", reached, 700, NOTHING);
            }
        }
        assertThat(told()).isEmpty();
        late("r", 8 * HOUR + MINUTE, 700, 8 * HOUR + MINUTE - 2000);
        assertThat(told()).isEmpty();
    }

    @Test
    void waitsForTenOfADeviceThatReportsSeldom() throws Exception {
        for (int minute = 0; minute < 9; minute++) {
            late("r", minute * MINUTE, 700, NOTHING);
        }
        assertThat(told()).isEmpty();
        late("r", 9 * MINUTE, 700, NOTHING);
        assertThat(told()).hasSize(1);
    }

    @Test
    void reportsADeviceThatReportsEveryQuarterOfAnHour() throws Exception {
        for (int report = 0; report < 12; report++) {
            late("r", report * 15 * MINUTE, 700, NOTHING);
        }
        assertThat(told())
                .extracting(ClockReport::positions, ClockReport::interval)
                .containsExactly(tuple(10, 15 * MINUTE), tuple(11, 15 * MINUTE), tuple(12, 15 * MINUTE));
    }

    private void late(String device, long reached, long by, long counted) throws Exception {
        LaggingPosition position =
                new LaggingPosition("data.raw", "farm|/|" + device, device, "weeding", reached - by, reached, counted);
        harness.processElement(position, position.time());
        harness.processWatermark(new Watermark(reached));
    }

    private List<ClockReport> told() {
        List<ClockReport> told = harness.extractOutputValues();
        assertThat(told).allMatch(report -> report.kind() == ClockReport.Kind.BEHIND);
        return told;
    }

    private void restart() throws Exception {
        OperatorSubtaskState snapshot = harness.snapshot(1, 1);
        List<Object> out = List.copyOf(harness.getOutput());
        harness.close();
        harness = new KeyedOneInputStreamOperatorTestHarness<>(
                new KeyedProcessOperator<>(new DetectClockLag(Duration.ofHours(1))),
                LaggingPosition::key,
                Types.STRING);
        harness.initializeState(snapshot);
        harness.open();
        harness.getOutput().addAll(out);
    }
}
