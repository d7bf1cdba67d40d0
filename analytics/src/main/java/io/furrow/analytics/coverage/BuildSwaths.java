package io.furrow.analytics.coverage;

import java.io.IOException;
import java.util.List;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.streaming.api.TimerService;
import org.apache.flink.util.Collector;

import io.furrow.analytics.eventtime.EventTimeBuffer;
import io.furrow.analytics.eventtime.SingleTimer;
import io.furrow.analytics.field.DeviceInFields;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.kafka.TopicSnapshot;

/**
 * Builds the swaths of robots in fields.
 *
 * <p><b>State</b>: beside that of {@link DeviceInFields}, of a robot its last position, working width and state, and the coverages to which
 * it has contributed, at most {@value SwathBuilder#MAX_OPENED}.
 *
 * <p><b>Cleared</b>: when it has reported nothing for the time-to-live of a coverage, at once where its working width is unknown.
 *
 * <p><b>Late</b>: see {@link DeviceInFields}. A swath beyond the maximum number of coverages is counted as {@code rejectedCrowded} too. A
 * version of a field that arrives too late applies from the next position on.
 *
 * <p><b>Emits</b>: each swath twice, for its robot and for all robots, a robot's in the order of their times, before the watermark.
 */
public final class BuildSwaths extends DeviceInFields<WorkReport, Swath> {
    private static final long serialVersionUID = 1L;

    private final CoverageRules rules;
    private final SwathBuilder builder;

    private transient ValueState<Drive> drive;

    public BuildSwaths(CoverageRules rules, TopicSnapshot atStart) {
        super(atStart);
        this.rules = rules;
        this.builder = new SwathBuilder(rules);
    }

    @Override
    public void open(OpenContext context) throws IOException {
        super.open(context);
        drive = getRuntimeContext().getState(new ValueStateDescriptor<>("drive", Drive.class));
    }

    @Override
    protected EventTimeBuffer<WorkReport> eventTimeBuffer(SingleTimer timer) {
        return new EventTimeBuffer<>(getRuntimeContext(), WorkReport.class, WorkReport.SEQUENCE, timer);
    }

    @Override
    protected PositionFix fix(WorkReport report) {
        return report.fix();
    }

    @Override
    protected long newestProcessed() throws IOException {
        Drive known = drive.value();
        return known == null ? Long.MIN_VALUE : known.time();
    }

    @Override
    protected void advance(List<WorkReport> due, TimerService timers, Collector<Swath> out) throws Exception {
        Drive known = drive.value();
        Drive now = known == null ? Drive.NONE : known;
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
