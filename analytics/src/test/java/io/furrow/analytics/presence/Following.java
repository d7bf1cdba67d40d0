package io.furrow.analytics.presence;

import java.util.ArrayList;
import java.util.List;
import java.util.Objects;

import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.runtime.state.KeyGroupRangeAssignment;
import org.apache.flink.runtime.state.heap.HeapKeyedStateBackend;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.streaming.util.AbstractStreamOperatorTestHarness;
import org.apache.flink.streaming.util.KeyedBroadcastOperatorTestHarness;

import io.furrow.analytics.clock.LaggingPosition;
import io.furrow.analytics.field.KnownFields;
import io.furrow.flink.BroadcastLatenessOperator;
import io.furrow.flink.TopicRecord;

/** {@link FollowDevices} alone, with time as data; can be stopped and go on with other subtasks, as from a savepoint. */
final class Following {
    private static final int KEY_GROUPS = 16;

    private PresenceRules rules;
    private final ArrayList<TopicRecord> topic = new ArrayList<>();
    private final List<PresenceFix> late = new ArrayList<>();
    private List<BroadcastLatenessOperator<String, PresenceFix, TopicRecord, Passage>> operators;
    private List<KeyedBroadcastOperatorTestHarness<String, PresenceFix, TopicRecord, Passage>> subtasks;

    Following(PresenceRules rules, int parallelism, List<TopicRecord> known) throws Exception {
        this.rules = rules;
        topic.addAll(known);
        start(parallelism, null, 0);
    }

    void receive(PresenceFix fix) throws Exception {
        subtasks.get(subtaskOf(fix)).processElement(new StreamRecord<>(fix, fix.time()));
    }

    /** What comes out of one subtask, on the way to a watermark that the others have not seen. */
    List<Passage> advance(int subtask, long watermark) throws Exception {
        subtasks.get(subtask).processWatermark(new Watermark(watermark));
        List<Passage> passages = new ArrayList<>(subtasks.get(subtask).extractOutputValues());
        subtasks.get(subtask).getOutput().clear();
        return passages;
    }

    int subtaskOf(PresenceFix fix) {
        return KeyGroupRangeAssignment.assignKeyToParallelOperator(fix.key(), KEY_GROUPS, subtasks.size());
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
        for (int subtask = 0; subtask < subtasks.size(); subtask++) {
            passages.addAll(advance(subtask, watermark));
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

    /** Late positions that are the newest of their device. */
    List<LaggingPosition> lagging() {
        return subtasks.stream()
                .map(subtask -> subtask.getSideOutput(FollowDevices.LAGGING))
                .filter(Objects::nonNull)
                .flatMap(side -> side.stream().map(StreamRecord::getValue))
                .toList();
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

    /** The same with other rules. */
    void restart(PresenceRules other) throws Exception {
        rules = other;
        restart(subtasks.size());
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
            var operator = new BroadcastLatenessOperator<>(
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
