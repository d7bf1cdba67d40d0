package io.furrow.analytics.coverage;

import java.io.IOException;
import java.util.List;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.metrics.Counter;
import org.apache.flink.streaming.api.TimerService;
import org.apache.flink.streaming.api.functions.co.KeyedBroadcastProcessFunction;
import org.apache.flink.util.Collector;
import org.apache.flink.util.OutputTag;

import io.furrow.analytics.clock.LaggingPosition;
import io.furrow.analytics.eventtime.EventTimeBuffer;
import io.furrow.analytics.eventtime.SingleTimer;
import io.furrow.analytics.field.FieldVersions;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.EventTimeProgress;
import io.furrow.flink.time.LatenessAware;

/**
 * Builds the swaths of robots in fields. Key: the device of a topic.
 *
 * <p><b>State</b>: reports that wait for the watermark; of a robot its last position, working width and state, and the coverages to which
 * it has contributed, at most {@value SwathBuilder#MAX_OPENED}. Fields: see {@link FieldVersions}.
 *
 * <p><b>Cleared</b>: when it has reported nothing for the time-to-live of a coverage, at once where its working width is unknown.
 *
 * <p><b>Late</b>: a report not after the watermark goes to {@link #LATE}, and to {@link #LAGGING} if the device has reported no newer one.
 * A report beyond the {@value #MAX_WAITING} waiting ones goes to {@code LATE} too, counted as {@code rejectedCrowded}, as is a swath beyond
 * the maximum number of coverages. A version of a field that arrives too late applies from the next position on.
 *
 * <p><b>Emits</b>: each swath twice, for its robot and for all robots, a robot's in the order of their times, before the watermark.
 */
public final class BuildSwaths extends KeyedBroadcastProcessFunction<String, WorkReport, TopicRecord, Swath>
        implements LatenessAware {
    static final OutputTag<PositionFix> LATE = new OutputTag<>("late") {
        private static final long serialVersionUID = 1L;
    };
    static final OutputTag<LaggingPosition> LAGGING = new OutputTag<>("lagging") {
        private static final long serialVersionUID = 1L;
    };
    /** Maximum per device. */
    static final int MAX_WAITING = 100_000;

    private static final long serialVersionUID = 1L;

    private final CoverageRules rules;
    private final SwathBuilder builder;
    private final TopicSnapshot atStart;

    private transient FieldVersions fields;
    private transient SingleTimer timer;
    private transient EventTimeBuffer<WorkReport> eventTimeBuffer;
    private transient ValueState<Drive> drive;
    private transient EventTimeProgress reached;
    private transient Counter accepted;
    private transient Counter late;
    private transient Counter rejectedCrowded;
    private transient Counter changes;

    public BuildSwaths(CoverageRules rules, TopicSnapshot atStart) {
        this.rules = rules;
        this.builder = new SwathBuilder(rules);
        this.atStart = atStart;
    }

    @Override
    public void judgeBy(EventTimeProgress reached) {
        this.reached = reached;
    }

    @Override
    public void open(OpenContext context) throws IOException {
        fields = FieldVersions.read(atStart);
        timer = new SingleTimer(getRuntimeContext());
        eventTimeBuffer = new EventTimeBuffer<>(getRuntimeContext(), WorkReport.class, WorkReport.SEQUENCE, timer);
        drive = getRuntimeContext().getState(new ValueStateDescriptor<>("drive", Drive.class));
        accepted = getRuntimeContext().getMetricGroup().counter("accepted");
        late = getRuntimeContext().getMetricGroup().counter("late");
        rejectedCrowded = getRuntimeContext().getMetricGroup().counter("rejectedCrowded");
        changes = getRuntimeContext().getMetricGroup().counter("fieldChanges");
    }

    @Override
    public void processElement(WorkReport report, ReadOnlyContext context, Collector<Swath> out) throws Exception {
        if (reached.hasPassed(report.time(), context.getCurrentKey())) {
            late.inc();
            context.output(LATE, report.fix());
            seeLagging(report.fix(), context);
        } else if (eventTimeBuffer.offer(report, MAX_WAITING, context.timerService())) {
            accepted.inc();
        } else {
            rejectedCrowded.inc();
            context.output(LATE, report.fix());
        }
    }

    private void seeLagging(PositionFix fix, ReadOnlyContext context) throws Exception {
        Drive known = drive.value();
        long counted = Math.max(known == null ? Long.MIN_VALUE : known.time(), eventTimeBuffer.newest());
        if (fix.time() > counted) {
            long now = reached.of(context.getCurrentKey());
            context.output(
                    LAGGING,
                    new LaggingPosition(
                            fix.topic(), fix.identity(), fix.id(), fix.mission(), fix.time(), now, counted));
        }
    }

    @Override
    public void processBroadcastElement(TopicRecord version, Context context, Collector<Swath> out) {
        if (fields.take(version)) {
            changes.inc();
        }
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<Swath> out) throws Exception {
        timer.rang();
        TimerService timers = context.timerService();
        Drive known = drive.value();
        Drive now = known == null ? Drive.NONE : known;
        List<WorkReport> due = eventTimeBuffer.takeDue(timers);
        for (int i = 0; i < due.size(); i++) {
            boolean isReplaced = i + 1 < due.size()
                    && due.get(i + 1).time() == due.get(i).time()
                    && due.get(i + 1).isLocated();
            if (!isReplaced) {
                now = builder.advance(now, due.get(i), fields, new Out(out));
            }
        }
        long end = now.time() + rules.timeToLive().toMillis();
        if (isUseless(now) || end <= timers.currentWatermark()) {
            drive.clear();
        } else {
            drive.update(now);
            timer.ask(end, timers);
        }
    }

    private boolean isUseless(Drive now) {
        return Double.isNaN(now.width()) && Double.isNaN(rules.width()) && now.work() == WorkReport.Work.UNKNOWN;
    }

    private final class Out implements SwathBuilder.Output {
        private final Collector<Swath> out;

        private Out(Collector<Swath> out) {
            this.out = out;
        }

        @Override
        public void accept(Swath swath) {
            out.collect(swath);
        }

        @Override
        public void reject() {
            rejectedCrowded.inc();
        }
    }
}
