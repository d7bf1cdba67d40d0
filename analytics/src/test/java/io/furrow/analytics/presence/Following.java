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
import io.furrow.analytics.field.FieldVersions;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.BroadcastLatenessOperator;

/** {@link TrackPresence} alone, with time as data; can be stopped and continue with other subtasks, as from a savepoint. */
final class Following {
    private static final int KEY_GROUPS = 16;

    private PresenceRules rules;
    private final ArrayList<TopicRecord> topic = new ArrayList<>();
    private final List<PositionFix> late = new ArrayList<>();
    private List<BroadcastLatenessOperator<String, PositionFix, TopicRecord, PresenceTransition>> operators;
    private List<KeyedBroadcastOperatorTestHarness<String, PositionFix, TopicRecord, PresenceTransition>> subtasks;

    Following(PresenceRules rules, int parallelism, List<TopicRecord> known) throws Exception {
        this.rules = rules;
        topic.addAll(known);
        start(parallelism, null, 0);
    }

    void receive(PositionFix fix) throws Exception {
        subtasks.get(subtaskOf(fix)).processElement(new StreamRecord<>(fix, fix.time()));
    }

    /** What comes out of one subtask, on the way to a watermark that the others have not seen. */
    List<PresenceTransition> advance(int subtask, long watermark) throws Exception {
        subtasks.get(subtask).processWatermark(new Watermark(watermark));
        List<PresenceTransition> passages =
                new ArrayList<>(subtasks.get(subtask).extractOutputValues());
        subtasks.get(subtask).getOutput().clear();
        return passages;
    }

    int subtaskOf(PositionFix fix) {
        return KeyGroupRangeAssignment.assignKeyToParallelOperator(fix.key(), KEY_GROUPS, subtasks.size());
    }

    void receive(TopicRecord version) throws Exception {
        topic.add(version);
        for (var subtask : subtasks) {
            subtask.processBroadcastElement(version, version.timestamp());
        }
    }

    /** What comes out on the way to the watermark. */
    List<PresenceTransition> advance(long watermark) throws Exception {
        List<PresenceTransition> passages = new ArrayList<>();
        for (int subtask = 0; subtask < subtasks.size(); subtask++) {
            passages.addAll(advance(subtask, watermark));
        }
        return passages;
    }

    List<PositionFix> late() {
        for (var subtask : subtasks) {
            var side = subtask.getSideOutput(TrackPresence.LATE);
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
                .map(subtask -> subtask.getSideOutput(TrackPresence.LAGGING))
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

    /** Stops with a snapshot and continues from it with so many subtasks. */
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
                    new TrackPresence(rules, () -> known), List.of(FieldVersions.BROADCAST));
            var harness = new KeyedBroadcastOperatorTestHarness<>(
                    operator, PositionFix::key, Types.STRING, KEY_GROUPS, parallelism, index);
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
