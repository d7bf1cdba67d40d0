package io.furrow.analytics.clock;

import java.time.Duration;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.analytics.eventtime.SingleTimer;
import io.furrow.model.topic.Topics;

/**
 * Reports devices with a streak of late positions. Key: the device of a topic.
 *
 * <p><b>State</b>: the streak, see {@link LagStreak}.
 *
 * <p><b>Cleared</b>: after 3 h of event time without a late position.
 *
 * <p><b>Late</b>: every input.
 *
 * <p><b>Emits</b>: that the device is behind, and at most once a minute of event time that it still is.
 */
public final class DetectClockLag extends KeyedProcessFunction<String, LaggingPosition, ClockReport> {
    private static final long serialVersionUID = 1L;

    private final long maxBehindMillis;
    private transient SingleTimer timer;
    private transient ValueState<LagStreak> streak;

    /** @param maxBehind {@link ReportDelayedDevices} reports devices that are further behind, except those of replays */
    DetectClockLag(Duration maxBehind) {
        this.maxBehindMillis = maxBehind.toMillis();
    }

    @Override
    public void open(OpenContext context) {
        timer = new SingleTimer(getRuntimeContext());
        streak = getRuntimeContext().getState(new ValueStateDescriptor<>("streak", LagStreak.class));
    }

    @Override
    public void processElement(LaggingPosition position, Context context, Collector<ClockReport> out) throws Exception {
        if (position.reached() - position.time() > maxBehindMillis && !Topics.isReplay(position.topic())) {
            return;
        }
        LagStreak now = LagStreak.after(streak.value(), position);
        if (now.isDue()) {
            out.collect(ClockReport.behind(position, now));
            now = now.afterReport();
        }
        streak.update(now);
        timer.ask(now.end(), context.timerService());
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<ClockReport> out) throws Exception {
        timer.rang();
        long end = streak.value().end();
        if (end <= context.timerService().currentWatermark()) {
            streak.clear();
        } else {
            timer.ask(end, context.timerService());
        }
    }
}
