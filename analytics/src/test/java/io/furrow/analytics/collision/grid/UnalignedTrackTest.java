package io.furrow.analytics.collision.grid;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.runtime.state.KeyGroupRangeAssignment;
import org.apache.flink.streaming.util.AbstractStreamOperatorTestHarness;
import org.apache.flink.streaming.util.KeyedOneInputStreamOperatorTestHarness;
import org.junit.jupiter.api.Test;

import io.furrow.analytics.collision.Fixes;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.Device;
import io.furrow.analytics.position.PositionFix;

import static org.assertj.core.api.Assertions.assertThat;

/** A checkpoint that has overtaken a watermark on its way to one of two subtasks. */
class UnalignedTrackTest {
    private static final int KEY_GROUPS = 16;
    private static final CollisionRules RULES =
            new CollisionRules(5, Duration.ofSeconds(3), Duration.ZERO, Duration.ZERO, 100);

    @Test
    void countsWhatWasOnItsWayToTheSubtaskThatWasBehind() throws Exception {
        var ahead = subtask(2, 0, null);
        var behind = subtask(2, 1, null);
        ahead.processWatermark(100_000);
        behind.processWatermark(90_000);
        OperatorSubtaskState state =
                AbstractStreamOperatorTestHarness.repackageState(ahead.snapshot(1, 1), behind.snapshot(1, 1));
        ahead.close();
        behind.close();

        for (int parallelism = 1; parallelism <= 2; parallelism++) {
            List<PositionFix> late = new ArrayList<>();
            for (int index = 0; index < parallelism; index++) {
                var again = subtask(
                        parallelism,
                        index,
                        AbstractStreamOperatorTestHarness.repartitionOperatorState(
                                state, KEY_GROUPS, 2, parallelism, index));
                for (PositionFix fix : List.of(fixAt(0), fixAt(1))) {
                    if (subtaskOf(fix, parallelism) == index) {
                        again.processElement(fix, fix.time());
                    }
                }
                if (again.getSideOutput(TrackDevices.LATE) != null) {
                    again.getSideOutput(TrackDevices.LATE).forEach(each -> late.add(each.getValue()));
                }
                again.close();
            }
            assertThat(late).as("with %d subtasks", parallelism).containsExactly(fixAt(0));
        }
    }

    /** Of a device that is at this of two subtasks. */
    private static PositionFix fixAt(int subtask) {
        int number = 0;
        while (subtaskOf(Fixes.east("r" + number, 0, 95_000), 2) != subtask) {
            number++;
        }
        return Fixes.east("r" + number, 0, 95_000);
    }

    private static int subtaskOf(PositionFix fix, int parallelism) {
        return KeyGroupRangeAssignment.assignKeyToParallelOperator(fix.device(), KEY_GROUPS, parallelism);
    }

    private static KeyedOneInputStreamOperatorTestHarness<Device, PositionFix, CellUpdate> subtask(
            int parallelism, int index, OperatorSubtaskState state) throws Exception {
        var subtask = new KeyedOneInputStreamOperatorTestHarness<>(
                new TrackDevices(RULES),
                PositionFix::device,
                TypeInformation.of(Device.class),
                KEY_GROUPS,
                parallelism,
                index);
        if (state != null) {
            subtask.initializeState(state);
        }
        subtask.open();
        return subtask;
    }
}
