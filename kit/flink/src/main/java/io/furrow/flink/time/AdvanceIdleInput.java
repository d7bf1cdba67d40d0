package io.furrow.flink.time;

import java.util.List;

import org.apache.flink.api.common.operators.ProcessingTimeService;
import org.apache.flink.api.common.state.ListState;
import org.apache.flink.api.common.state.ListStateDescriptor;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.api.java.tuple.Tuple2;
import org.apache.flink.runtime.state.StateInitializationContext;
import org.apache.flink.runtime.state.StateSnapshotContext;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.operators.AbstractStreamOperator;
import org.apache.flink.streaming.api.operators.OneInputStreamOperator;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.streaming.runtime.watermarkstatus.WatermarkStatus;

import io.furrow.flink.job.JobOptions;
import io.furrow.flink.record.TopicRecord;

/**
 * Advances event time with the wall clock while no record has arrived since a restart, like {@link ClockBoundedWatermarks} with the idle
 * advance after a record: those have no state from before the restart. It continues from the last event time; downtime does not count,
 * because a backlog may still have to be read. A quiet subtask is active only for its watermarks, so that it does not hold back any that is
 * further.
 *
 * <p>State: the union list {@code idle-input} with the event time of each subtask, epoch milliseconds, and whether it received records: if
 * any did, only those count. Late: not decided here. Emits: records unchanged; watermarks that are higher than those before.
 */
public final class AdvanceIdleInput<T> extends AbstractStreamOperator<T>
        implements OneInputStreamOperator<T, T>, ProcessingTimeService.ProcessingTimeCallback {
    private static final long serialVersionUID = 1L;
    private static final long NOTHING_YET = Long.MIN_VALUE;
    private static final long INTERVAL_MILLIS = 200;

    private transient ListState<Tuple2<Long, Boolean>> saved;
    /** Event time before the restart, of the slowest subtask with records; of the furthest if none had any. */
    private transient long before;
    /** Event time of this subtask. */
    private transient long reached;
    /** Whether a watermark has arrived, which requires a record. */
    private transient boolean fed;

    private transient boolean quiet;
    private transient long quietSince;

    /** The input of a job, with event time that continues if configured. */
    public static DataStream<TopicRecord> of(DataStream<TopicRecord> input, JobOptions options) {
        return options.idleAdvance()
                ? input.transform("Advance idle input", input.getType(), new AdvanceIdleInput<>())
                        .uid("advance-idle-input")
                : input;
    }

    @Override
    public void initializeState(StateInitializationContext context) throws Exception {
        super.initializeState(context);
        saved = context.getOperatorStateStore()
                .getUnionListState(new ListStateDescriptor<>("idle-input", Types.TUPLE(Types.LONG, Types.BOOLEAN)));
        long slowest = Long.MAX_VALUE;
        long furthest = NOTHING_YET;
        RestoredTimeLimit limit = RestoredTimeLimit.of(getRuntimeContext());
        for (Tuple2<Long, Boolean> each : saved.get()) {
            if (limit.allows(each.f0)) {
                slowest = each.f1 ? Math.min(slowest, each.f0) : slowest;
                furthest = Math.max(furthest, each.f0);
            }
        }
        before = slowest == Long.MAX_VALUE ? furthest : slowest;
        reached = NOTHING_YET;
    }

    @Override
    public void processElement(StreamRecord<T> element) {
        output.collect(element);
    }

    @Override
    public void processWatermark(Watermark mark) throws Exception {
        if (!fed && quiet) {
            output.emitWatermarkStatus(WatermarkStatus.ACTIVE);
        }
        fed = true;
        if (EndOfEventTime.isAt(mark.getTimestamp())) {
            super.processWatermark(mark);
        } else {
            advance(mark.getTimestamp());
        }
    }

    private void advance(long time) throws Exception {
        if (time > reached) {
            reached = time;
            super.processWatermark(new Watermark(time));
        }
    }

    /** A subtask is idle if no partition has had a record since the start. */
    @Override
    public void processWatermarkStatus(WatermarkStatus status) throws Exception {
        if (before == NOTHING_YET || fed) {
            super.processWatermarkStatus(status);
        } else if (status.isIdle() && !quiet) {
            quiet = true;
            quietSince = getProcessingTimeService().getCurrentProcessingTime();
            onProcessingTime(quietSince);
        }
    }

    @Override
    public void onProcessingTime(long clock) throws Exception {
        if (!fed) {
            output.emitWatermarkStatus(WatermarkStatus.ACTIVE);
            advance(before + clock - quietSince);
            output.emitWatermarkStatus(WatermarkStatus.IDLE);
            getProcessingTimeService().registerTimer(clock + INTERVAL_MILLIS, this);
        }
    }

    @Override
    public void snapshotState(StateSnapshotContext context) throws Exception {
        super.snapshotState(context);
        long time = Math.max(before, reached);
        saved.update(time == NOTHING_YET ? List.of() : List.of(Tuple2.of(time, fed)));
    }
}
