package io.furrow.analytics.presence;

import java.util.ArrayList;
import java.util.List;

import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.runtime.state.KeyGroupRangeAssignment;
import org.apache.flink.runtime.state.heap.HeapKeyedStateBackend;
import org.apache.flink.streaming.api.operators.co.CoBroadcastWithKeyedOperator;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.streaming.util.AbstractStreamOperatorTestHarness;
import org.apache.flink.streaming.util.KeyedBroadcastOperatorTestHarness;

import io.furrow.analytics.field.KnownFields;
import io.furrow.flink.TopicRecord;

/** {@link FollowDevices} alone, with time as data; can be stopped and go on with other subtasks, as from a savepoint. */
final class Following {
    private static final int KEY_GROUPS = 16;

    private final PresenceRules rules;
    private final ArrayList<TopicRecord> topic = new ArrayList<>();
    private final List<PresenceFix> late = new ArrayList<>();
    private List<CoBroadcastWithKeyedOperator<String, PresenceFix, TopicRecord, Passage>> operators;
    private List<KeyedBroadcastOperatorTestHarness<String, PresenceFix, TopicRecord, Passage>> subtasks;

    Following(PresenceRules rules, int parallelism, List<TopicRecord> known) throws Exception {
        this.rules = rules;
        topic.addAll(known);
        start(parallelism, null, 0);
    }

    void receive(PresenceFix fix) throws Exception {
        int subtask = KeyGroupRangeAssignment.assignKeyToParallelOperator(fix.key(), KEY_GROUPS, subtasks.size());
        subtasks.get(subtask).processElement(new StreamRecord<>(fix, fix.time()));
    }

    void receive(TopicRecord version) throws Exception {
        topic.add(version);
        for (var subtask : subtasks) {
            subtask.processBroadcastElement(version, version.timestamp());
        }
    }

    /** What comes out on the way to the watermark. */
    List<Passage> advance(long watermark) throws Exception {
        List<Passage> passages = new ArrayList<>();
        for (var subtask : subtasks) {
            subtask.processWatermark(new Watermark(watermark));
            passages.addAll(subtask.extractOutputValues());
            subtask.getOutput().clear();
        }
        return passages;
    }

    List<PresenceFix> late() {
        for (var subtask : subtasks) {
            var side = subtask.getSideOutput(FollowDevices.LATE);
            if (side != null) {
                side.forEach(record -> late.add(record.getValue()));
                side.clear();
            }
        }
        return late;
    }

    int stateEntries() {
        return operators.stream()
                .mapToInt(one -> ((HeapKeyedStateBackend<?>) one.getKeyedStateBackend()).numKeyValueStateEntries())
                .sum();
    }

    int timers() {
        return subtasks.stream().mapToInt(one -> one.numEventTimeTimers()).sum();
    }

    /** Stops with a snapshot and goes on from it with so many subtasks. */
    void restart(int parallelism) throws Exception {
        late();
        OperatorSubtaskState[] snapshots = new OperatorSubtaskState[subtasks.size()];
        for (int subtask = 0; subtask < subtasks.size(); subtask++) {
            snapshots[subtask] = subtasks.get(subtask).snapshot(1, 1);
        }
        stop();
        start(parallelism, AbstractStreamOperatorTestHarness.repackageState(snapshots), snapshots.length);
    }

    void stop() throws Exception {
        for (var subtask : subtasks) {
            subtask.close();
        }
    }

    private void start(int parallelism, OperatorSubtaskState state, int before) throws Exception {
        subtasks = new ArrayList<>();
        operators = new ArrayList<>();
        for (int index = 0; index < parallelism; index++) {
            ArrayList<TopicRecord> known = new ArrayList<>(topic);
            var operator = new CoBroadcastWithKeyedOperator<>(
                    new FollowDevices(rules, () -> known), List.of(KnownFields.BROADCAST));
            var harness = new KeyedBroadcastOperatorTestHarness<>(
                    operator, PresenceFix::key, Types.STRING, KEY_GROUPS, parallelism, index);
            operators.add(operator);
            if (state != null) {
                harness.initializeState(AbstractStreamOperatorTestHarness.repartitionOperatorState(
                        state, KEY_GROUPS, before, parallelism, index));
            }
            harness.open();
            harness.processBroadcastWatermark(Watermark.MAX_WATERMARK);
            subtasks.add(harness);
        }
    }
}
