package io.furrow.analytics.field;

import java.io.IOException;
import java.util.List;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.streaming.api.TimerService;
import org.apache.flink.streaming.api.functions.co.KeyedBroadcastProcessFunction;
import org.apache.flink.util.Collector;
import org.apache.flink.util.OutputTag;

import io.furrow.analytics.clock.LaggingPosition;
import io.furrow.analytics.eventtime.EventTimeBuffer;
import io.furrow.analytics.eventtime.HasEventTime;
import io.furrow.analytics.eventtime.SingleTimer;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.EventTimeProgress;
import io.furrow.flink.time.LatenessAware;

/**
 * Processes the reports of a device in the order of event time, with the fields. Key: the device of a topic.
 *
 * <p><b>State</b>: reports that wait for the watermark; fields: see {@link FieldVersions}.
 *
 * <p><b>Late</b>: a report not after the watermark goes to {@link #LATE}, and to {@link #LAGGING} if the device has reported no newer one.
 * A report beyond the {@value #MAX_WAITING} waiting ones goes to {@code LATE} too, counted as {@code rejectedCrowded}.
 *
 * @param <T> a report
 * @param <OUT> a result
 */
public abstract class DeviceInFields<T extends HasEventTime, OUT>
        extends KeyedBroadcastProcessFunction<String, T, TopicRecord, OUT> implements LatenessAware {
    public static final OutputTag<PositionFix> LATE = new OutputTag<>("late") {
        private static final long serialVersionUID = 1L;
    };
    public static final OutputTag<LaggingPosition> LAGGING = new OutputTag<>("lagging") {
        private static final long serialVersionUID = 1L;
    };
    /** Maximum per device. */
    public static final int MAX_WAITING = 100_000;

    private static final long serialVersionUID = 1L;

    private final TopicSnapshot atStart;

    protected transient FieldVersions fields;
    protected transient SingleTimer timer;
    protected transient Counter rejectedCrowded;
    private transient EventTimeBuffer<T> eventTimeBuffer;
    private transient EventTimeProgress reached;
    private transient Counter accepted;
    private transient Counter late;
    private transient Counter changes;

    /** @param atStart the topic of fields when the job starts */
    protected DeviceInFields(TopicSnapshot atStart) {
        this.atStart = atStart;
    }

    /** The state of reports that wait for the watermark. */
    protected abstract EventTimeBuffer<T> eventTimeBuffer(SingleTimer timer);

    /** The position of a report. */
    protected abstract PositionFix fix(T report);

    /** Time of the device's newest report that was processed, epoch ms; {@link Long#MIN_VALUE} without any. */
    protected abstract long newestProcessed() throws IOException;

    /** Processes the reports up to the watermark, in order; none if only a timer has fired. */
    protected abstract void advance(List<T> due, TimerService timers, Collector<OUT> out) throws Exception;

    @Override
    public void judgeBy(EventTimeProgress reached) {
        this.reached = reached;
    }

    @Override
    public void open(OpenContext context) throws IOException {
        fields = FieldVersions.read(atStart);
        timer = new SingleTimer(getRuntimeContext());
        eventTimeBuffer = eventTimeBuffer(timer);
        accepted = getRuntimeContext().getMetricGroup().counter("accepted");
        late = getRuntimeContext().getMetricGroup().counter("late");
        rejectedCrowded = getRuntimeContext().getMetricGroup().counter("rejectedCrowded");
        changes = getRuntimeContext().getMetricGroup().counter("fieldChanges");
    }

    @Override
    public void processElement(T report, ReadOnlyContext context, Collector<OUT> out) throws Exception {
        if (reached.hasPassed(report.time(), context.getCurrentKey())) {
            late.inc();
            context.output(LATE, fix(report));
            emitLagging(fix(report), context);
        } else if (eventTimeBuffer.offer(report, MAX_WAITING, context.timerService())) {
            accepted.inc();
        } else {
            rejectedCrowded.inc();
            context.output(LATE, fix(report));
        }
    }

    private void emitLagging(PositionFix fix, ReadOnlyContext context) throws Exception {
        long counted = Math.max(newestProcessed(), eventTimeBuffer.newest());
        if (fix.time() > counted) {
            long now = reached.of(context.getCurrentKey());
            context.output(
                    LAGGING,
                    new LaggingPosition(
                            fix.topic(), fix.identity(), fix.id(), fix.mission(), fix.time(), now, counted));
        }
    }

    @Override
    public void processBroadcastElement(TopicRecord version, Context context, Collector<OUT> out) {
        if (fields.take(version)) {
            changes.inc();
        }
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<OUT> out) throws Exception {
        timer.rang();
        advance(eventTimeBuffer.takeDue(context.timerService()), context.timerService(), out);
    }
}
