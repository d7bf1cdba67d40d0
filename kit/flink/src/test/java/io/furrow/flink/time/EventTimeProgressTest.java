package io.furrow.flink.time;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.runtime.state.KeyGroupRangeAssignment;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.streaming.api.operators.OneInputStreamOperator;
import org.apache.flink.streaming.util.AbstractStreamOperatorTestHarness;
import org.apache.flink.streaming.util.KeyedOneInputStreamOperatorTestHarness;
import org.apache.flink.util.Collector;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

import io.furrow.flink.job.JobEnvironment;

import static org.assertj.core.api.Assertions.assertThat;

/** Elements are keys; their timestamps decide. */
class EventTimeProgressTest {
    private static final int KEY_GROUPS = 16;

    private final List<KeyedOneInputStreamOperatorTestHarness<String, String, String>> opened = new ArrayList<>();
    private String maxAhead;

    @AfterEach
    void close() throws Exception {
        for (var each : opened) {
            each.close();
        }
    }

    @Test
    void judgesAfterARestartAsBeforeItsFirstWatermark() throws Exception {
        List<KeyedOneInputStreamOperatorTestHarness<String, String, String>> before = start(2);
        before.get(0).processWatermark(1_000);
        before.get(1).processWatermark(1_000);

        var again = restarted(restarted(before, 3), 1).get(0);
        again.processElement("a", 1_000);
        again.processElement("b", 1_001);
        assertThat(again.extractOutputValues()).containsExactly("a late", "b");

        again.processWatermark(500);
        again.processElement("a", 1_000);
        again.processWatermark(2_000);
        again.processElement("b", 2_000);
        assertThat(again.extractOutputValues()).containsExactly("a late", "b", "a late", "b late");
    }

    @Test
    void judgesEachKeyByTheSubtaskThatItWasAt() throws Exception {
        List<KeyedOneInputStreamOperatorTestHarness<String, String, String>> before = start(2);
        before.get(0).processWatermark(1_000);
        before.get(1).processWatermark(900);

        var again = restarted(before, 1).get(0);
        again.processElement(keyAt(0), 950);
        again.processElement(keyAt(1), 950);
        again.processElement(keyAt(1), 900);
        assertThat(again.extractOutputValues()).containsExactly(keyAt(0) + " late", keyAt(1), keyAt(1) + " late");

        var split = restarted(restarted(before, 1), 2);
        split.get(0).processElement(keyAt(0), 950);
        split.get(1).processElement(keyAt(1), 950);
        assertThat(split.get(0).extractOutputValues()).containsExactly(keyAt(0) + " late");
        assertThat(split.get(1).extractOutputValues()).containsExactly(keyAt(1));
    }

    @Test
    void goesOnAfterAJobWasDrained() throws Exception {
        var before = start(1);
        before.get(0).processWatermark(1_000);
        before.get(0).processWatermark(Long.MAX_VALUE);

        var again = restarted(before, 1).get(0);
        again.processElement("a", 1_000);
        again.processElement("a", 1_001);
        assertThat(again.extractOutputValues()).containsExactly("a late", "a");
    }

    @Test
    void startsAnewIfTheClockWasAhead() throws Exception {
        long ahead = System.currentTimeMillis() + 3_600_000;
        var before = start(1);
        before.get(0).processWatermark(ahead);

        var replay = restarted(before, 1).get(0);
        replay.processElement("a", ahead);
        assertThat(replay.extractOutputValues()).containsExactly("a late");

        maxAhead = "PT10S";
        var again = restarted(before, 1).get(0);
        again.processElement("a", 1_000);
        again.processWatermark(1_000);
        again.processElement("a", 1_000);
        assertThat(again.extractOutputValues()).containsExactly("a", "a late");
    }

    private static String keyAt(int subtaskOfTwo) {
        int i = 0;
        while (KeyGroupRangeAssignment.assignKeyToParallelOperator("k" + i, KEY_GROUPS, 2) != subtaskOfTwo) {
            i++;
        }
        return "k" + i;
    }

    private List<KeyedOneInputStreamOperatorTestHarness<String, String, String>> start(int parallelism)
            throws Exception {
        List<KeyedOneInputStreamOperatorTestHarness<String, String, String>> subtasks = new ArrayList<>();
        for (int index = 0; index < parallelism; index++) {
            subtasks.add(harness(new KeyedLatenessOperator<>(new Judge()), parallelism, index));
            subtasks.get(index).open();
        }
        return subtasks;
    }

    private List<KeyedOneInputStreamOperatorTestHarness<String, String, String>> restarted(
            List<KeyedOneInputStreamOperatorTestHarness<String, String, String>> before, int parallelism)
            throws Exception {
        OperatorSubtaskState[] snapshots = new OperatorSubtaskState[before.size()];
        for (int index = 0; index < snapshots.length; index++) {
            snapshots[index] = before.get(index).snapshot(1, 1);
        }
        OperatorSubtaskState state = AbstractStreamOperatorTestHarness.repackageState(snapshots);
        List<KeyedOneInputStreamOperatorTestHarness<String, String, String>> subtasks = new ArrayList<>();
        for (int index = 0; index < parallelism; index++) {
            var subtask = harness(new KeyedLatenessOperator<>(new Judge()), parallelism, index);
            subtask.initializeState(AbstractStreamOperatorTestHarness.repartitionOperatorState(
                    state, KEY_GROUPS, snapshots.length, parallelism, index));
            subtask.open();
            subtasks.add(subtask);
        }
        return subtasks;
    }

    private KeyedOneInputStreamOperatorTestHarness<String, String, String> harness(
            OneInputStreamOperator<String, String> operator, int parallelism, int index) throws Exception {
        var harness = new KeyedOneInputStreamOperatorTestHarness<>(
                operator, key -> key, Types.STRING, KEY_GROUPS, parallelism, index);
        if (maxAhead != null) {
            harness.getExecutionConfig()
                    .setGlobalJobParameters(Configuration.fromMap(Map.of(JobEnvironment.MAX_RESTORED_AHEAD, maxAhead)));
        }
        opened.add(harness);
        return harness;
    }

    private static final class Judge extends KeyedProcessFunction<String, String, String> implements LatenessAware {
        private static final long serialVersionUID = 1L;

        private transient EventTimeProgress reached;

        @Override
        public void judgeBy(EventTimeProgress reached) {
            this.reached = reached;
        }

        @Override
        public void processElement(String key, Context context, Collector<String> out) {
            out.collect(reached.hasPassed(context.timestamp(), key) ? key + " late" : key);
        }
    }
}
