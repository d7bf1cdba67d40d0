package io.furrow.analytics.collision;

import java.util.List;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.analytics.eventtime.Inbox;
import io.furrow.analytics.eventtime.OneTimer;

/**
 * Finds the close pairs of each grid cell. Key: the cell's id.
 *
 * <p><b>State</b>: updates that wait for the watermark, the devices in the cell and around it.
 *
 * <p><b>Cleared</b>: when the last device has gone and no update waits.
 *
 * <p><b>Late</b>: nothing can be, the stage before acts before it forwards a watermark.
 *
 * <p><b>Emits</b>: a sighting for each instant at which a pair is or was close and either device reported or left.
 */
public final class MatchPairs extends KeyedProcessFunction<Long, CellUpdate, Sighting> {
    private static final long serialVersionUID = 1L;

    private final Proximity proximity;

    private transient OneTimer timer;
    private transient Inbox<CellUpdate> inbox;
    private transient ValueState<Cell> cell;

    MatchPairs(CollisionRules rules) {
        proximity = new Proximity(rules);
    }

    @Override
    public void open(OpenContext context) {
        timer = new OneTimer(getRuntimeContext());
        inbox = new Inbox<>(getRuntimeContext(), CellUpdate.class, CellUpdate.SEQUENCE, timer);
        cell = getRuntimeContext().getState(new ValueStateDescriptor<>("cell", Cell.class));
    }

    @Override
    public void processElement(CellUpdate update, Context context, Collector<Sighting> out) throws Exception {
        inbox.add(update, context.timerService());
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<Sighting> out) throws Exception {
        timer.rang();
        List<CellUpdate> due = inbox.takeDue(context.timerService());
        Cell known = cell.value();
        Cell now = known == null ? Cell.empty() : known;
        now.apply(due, proximity, out::collect);
        if (now.isEmpty()) {
            cell.clear();
        } else {
            cell.update(now);
        }
    }
}
