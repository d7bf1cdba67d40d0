package io.furrow.analytics.temperature.suspect;

import java.time.Duration;
import java.util.List;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.analytics.eventtime.Inbox;
import io.furrow.analytics.eventtime.OneTimer;
import io.furrow.flink.record.ByType;
import io.furrow.flink.time.EventTimeReached;
import io.furrow.flink.time.JudgesLateness;

/**
 * Reports a device once that stays suspect for a number of windows in a row, and again only after it was sound in between. In
 * a window it is suspect if any field sets it aside, sound if none does; a window without a verdict (no reading, or too few
 * devices to decide) neither counts nor interrupts.
 *
 * <p>State: verdicts that wait for the watermark, and of a suspect device its run of windows; keyed by id, and in it by type. Cleared: by the first window in
 * which it is sound, or when no verdict has come for the memory. Late: a corrected verdict of a window that event time has
 * passed, in this run or an earlier one, is skipped. Emits: a report when the watermark passes the window that was one too many.
 */
public final class TrackSuspects extends KeyedProcessFunction<String, Verdict, SuspectDevice>
        implements JudgesLateness {
    private static final ByType.Descriptor<SuspectRun> RUN =
            new ByType.Descriptor<>("run", SuspectRun.class, SuspectRun::type);

    private static final long serialVersionUID = 1L;

    private final int windows;
    private final long memoryMillis;
    private transient OneTimer timer;
    private transient Inbox<Verdict> inbox;
    private transient ByType<SuspectRun> runs;
    private transient EventTimeReached reached;

    public TrackSuspects(int windows, Duration memory) {
        this.windows = windows;
        this.memoryMillis = memory.toMillis();
    }

    @Override
    public void judgeBy(EventTimeReached reached) {
        this.reached = reached;
    }

    @Override
    public void open(OpenContext context) {
        timer = new OneTimer(getRuntimeContext());
        inbox = new Inbox<>(getRuntimeContext(), Verdict.class, Verdict.SEQUENCE, timer);
        runs = RUN.of(getRuntimeContext());
    }

    @Override
    public void processElement(Verdict verdict, Context context, Collector<SuspectDevice> out) throws Exception {
        if (!reached.hasPassed(verdict.time(), context.getCurrentKey())) {
            inbox.add(verdict, context.timerService());
        }
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<SuspectDevice> out) throws Exception {
        timer.rang();
        List<Verdict> due = inbox.takeDue(context.timerService());
        Verdict judged = null;
        for (Verdict verdict : due) {
            if (!verdict.isOfSameWindow(judged)) { // the first of a window decides: suspect ones come first
                judge(verdict, out);
                judged = verdict;
            }
        }
        for (SuspectRun known : runs.allOf("")) {
            if (known.until() + memoryMillis <= time) {
                runs.remove(known);
            } else {
                timer.ask(known.until() + memoryMillis, context.timerService());
            }
        }
    }

    private void judge(Verdict verdict, Collector<SuspectDevice> out) throws Exception {
        SuspectRun known = verdict.type() == null ? runs.first() : runs.get(verdict.type());
        if (!verdict.suspect()) {
            if (known != null) {
                runs.remove(known);
            }
            return;
        }
        boolean isForgotten = known != null && known.until() + memoryMillis <= verdict.time();
        SuspectRun longer = SuspectRun.after(isForgotten ? null : known, verdict);
        runs.put(longer.type(), longer);
        if (longer.windows() == windows) {
            out.collect(new SuspectDevice(verdict, longer.windows(), longer.since()));
        }
    }
}
