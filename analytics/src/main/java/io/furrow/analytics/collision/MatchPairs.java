package io.furrow.analytics.collision;

import java.util.ArrayList;
import java.util.List;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.metrics.Counter;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;
import org.apache.flink.util.OutputTag;

import io.furrow.analytics.eventtime.PendingState;

/**
 * Finds the close pairs of each grid cell. Key: the cell's id.
 *
 * <p><b>State</b>: updates that wait for the watermark, the devices in the cell and around it, the pairs that are
 * followed where their number is limited.
 *
 * <p><b>Cleared</b>: when the last device has gone, no pair is close and no update waits.
 *
 * <p><b>Late</b>: nothing can be, the stage before acts before it forwards a watermark.
 *
 * <p><b>Emits</b>: a sighting for each instant at which a pair is or was close and either device reported or left.
 * What the limit leaves out goes to {@link #OVERFLOWS} and is counted as {@code pairs.left-out}.
 */
public final class MatchPairs extends KeyedProcessFunction<Long, CellUpdate, Sighting> {
    static final OutputTag<CellOverflow> OVERFLOWS = new OutputTag<>("overflows") {
        private static final long serialVersionUID = 1L;
    };

    private static final long serialVersionUID = 1L;

    private final Proximity proximity;
    private final PairLimit limit;
    private final Grid grid;

    private transient PendingState<CellUpdate, Cell> cell;
    private transient ValueState<Crowd> crowd;
    private transient Counter leftOut;

    MatchPairs(CollisionRules rules) {
        proximity = new Proximity(rules.exact());
        limit = new PairLimit(rules);
        grid = new Grid(rules.exact());
    }

    @Override
    public void open(OpenContext context) {
        cell = new PendingState<>(getRuntimeContext(), new PendingUpdatesFormat(), CellUpdate.SEQUENCE);
        crowd = getRuntimeContext().getState(new ValueStateDescriptor<>("crowd", Crowd.class));
        leftOut = getRuntimeContext().getMetricGroup().counter("pairs.left-out");
    }

    @Override
    public void processElement(CellUpdate update, Context context, Collector<Sighting> out) throws Exception {
        cell.add(update, context.timerService());
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<Sighting> out) throws Exception {
        cell.advance(
                time,
                context.timerService(),
                (before, due) -> {
                    Cell now = before == null ? Cell.empty() : before;
                    if (limit.isNone()) {
                        now.apply(due, proximity, out::collect);
                    } else {
                        applyLimited(now, due, context, out);
                    }
                    return now.isEmpty() ? null : now;
                },
                remembered -> PendingState.NEVER);
    }

    /** Instant by instant, so that what is told of an instant does not depend on how far the watermark went. */
    private void applyLimited(Cell now, List<CellUpdate> due, OnTimerContext context, Collector<Sighting> out)
            throws Exception {
        Crowd pairs = crowd.value();
        int from = 0;
        while (from < due.size()) {
            int to = from + 1;
            while (to < due.size() && due.get(to).time() == due.get(from).time()) {
                to++;
            }
            List<Sighting> seen = new ArrayList<>();
            now.apply(due.subList(from, to), proximity, seen::add);
            pairs = limit.apply(pairs, seen, new Limited(now, context, out));
            from = to;
        }
        crowd.update(pairs); // null clears
    }

    /** Where the pairs of the current cell go. */
    private final class Limited implements PairLimit.Output {
        private final Cell cell;
        private final OnTimerContext context;
        private final Collector<Sighting> out;

        Limited(Cell cell, OnTimerContext context, Collector<Sighting> out) {
            this.cell = cell;
            this.context = context;
            this.out = out;
        }

        @Override
        public void sighting(Sighting sighting) {
            out.collect(sighting);
        }

        @Override
        public void overflow(Crowd now, Sighting cause) {
            context.output(OVERFLOWS, now.overflow(cause, cell.devices(), context.getCurrentKey(), grid));
        }

        @Override
        public void leftOut() {
            leftOut.inc();
        }
    }
}
