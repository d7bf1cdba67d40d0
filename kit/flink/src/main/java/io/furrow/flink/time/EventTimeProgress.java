package io.furrow.flink.time;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;

import org.apache.flink.api.common.TaskInfo;
import org.apache.flink.api.common.functions.RuntimeContext;
import org.apache.flink.api.common.state.ListState;
import org.apache.flink.api.common.state.ListStateDescriptor;
import org.apache.flink.api.common.state.OperatorStateStore;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.api.java.tuple.Tuple3;
import org.apache.flink.runtime.state.KeyGroupRange;
import org.apache.flink.runtime.state.KeyGroupRangeAssignment;

/**
 * Stores the event time reached for the keys of a subtask, in this run or in an earlier one, in epoch milliseconds. Watermarks
 * are in no checkpoint: without it a restored job would accept late events until its first watermark.
 *
 * <p>Each key group has its own: in an unaligned checkpoint one subtask may have passed a watermark that is still in flight to
 * another, and events before that watermark are not late. The end of event time is not stored, so that a job that was stopped
 * with {@code --drain} can continue. Event time of when the clock was ahead is not restored, see {@link RestoredTimeLimit}.
 *
 * <p>State: the union list {@code event-time-reached-by-key-group} with ranges of key groups (first, last, time).
 */
public final class EventTimeProgress {
    private static final long NOTHING_YET = Long.MIN_VALUE;

    private final ListState<Tuple3<Integer, Integer, Long>> byKeyGroup;
    private final KeyGroupRange keyGroups;
    private final int maxParallelism;
    /** The event time of earlier runs, from the first key group on; null once this run has passed all of it. */
    private long[] before;

    private long now = NOTHING_YET;

    private EventTimeProgress(OperatorStateStore states, TaskInfo task) throws Exception {
        maxParallelism = task.getMaxNumberOfParallelSubtasks();
        keyGroups = KeyGroupRangeAssignment.computeKeyGroupRangeForOperatorIndex(
                maxParallelism, task.getNumberOfParallelSubtasks(), task.getIndexOfThisSubtask());
        byKeyGroup = states.getUnionListState(new ListStateDescriptor<>(
                "event-time-reached-by-key-group", Types.TUPLE(Types.INT, Types.INT, Types.LONG)));
    }

    /** Restores from the task's checkpoint, if there is one. */
    public static EventTimeProgress restore(OperatorStateStore states, RuntimeContext runtime) throws Exception {
        EventTimeProgress reached = new EventTimeProgress(states, runtime.getTaskInfo());
        reached.read(RestoredTimeLimit.of(runtime));
        return reached;
    }

    private void read(RestoredTimeLimit limit) throws Exception {
        before = new long[keyGroups.getNumberOfKeyGroups()];
        Arrays.fill(before, NOTHING_YET);
        int first = keyGroups.getStartKeyGroup();
        for (Tuple3<Integer, Integer, Long> range : byKeyGroup.get()) {
            if (!EndOfEventTime.isAt(range.f2) && limit.allows(range.f2)) {
                take(Math.max(first, range.f0), Math.min(keyGroups.getEndKeyGroup(), range.f1), range.f2);
            }
        }
        forgetWhatIsPassed();
    }

    private void take(int first, int last, long time) {
        for (int group = first; group <= last; group++) {
            int index = group - keyGroups.getStartKeyGroup();
            before[index] = Math.max(before[index], time);
        }
    }

    /** Must be called with each watermark, before it is processed. */
    public void advance(long watermark) {
        if (watermark > now && !EndOfEventTime.isAt(watermark)) {
            now = watermark;
            forgetWhatIsPassed();
        }
    }

    private void forgetWhatIsPassed() {
        if (before != null && Arrays.stream(before).allMatch(each -> each <= now)) {
            before = null;
        }
    }

    /** {@link Long#MIN_VALUE} before the first watermark of the first run. */
    public long of(Object key) {
        return before == null ? now : Math.max(now, before[indexOf(key)]);
    }

    /** The greatest event time of the key groups of this subtask. */
    long furthest() {
        return before == null ? now : Math.max(now, Arrays.stream(before).max().orElse(NOTHING_YET));
    }

    /** Whether an event of this time and key is late. */
    public boolean hasPassed(long time, Object key) {
        return time <= now || before != null && time <= before[indexOf(key)];
    }

    private int indexOf(Object key) {
        return KeyGroupRangeAssignment.assignToKeyGroup(key, maxParallelism) - keyGroups.getStartKeyGroup();
    }

    /** Writes the state for a checkpoint. */
    public void snapshot() throws Exception {
        List<Tuple3<Integer, Integer, Long>> ranges = new ArrayList<>();
        int first = keyGroups.getStartKeyGroup();
        for (int group = first; group <= keyGroups.getEndKeyGroup(); group++) {
            if (group == keyGroups.getEndKeyGroup() || at(group + 1) != at(group)) {
                ranges.add(Tuple3.of(first, group, at(group)));
                first = group + 1;
            }
        }
        byKeyGroup.update(ranges);
    }

    private long at(int keyGroup) {
        return before == null ? now : Math.max(now, before[keyGroup - keyGroups.getStartKeyGroup()]);
    }
}
