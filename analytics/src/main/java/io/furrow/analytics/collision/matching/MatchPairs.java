package io.furrow.analytics.collision.matching;

import java.util.Comparator;
import java.util.List;
import java.util.function.Consumer;

import org.apache.flink.metrics.Counter;
import org.apache.flink.runtime.state.StateInitializationContext;
import org.apache.flink.runtime.state.StateSnapshotContext;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.util.Collector;
import org.apache.flink.util.OutputTag;

import io.furrow.analytics.collision.encounter.PairObservation;
import io.furrow.analytics.collision.grid.CellUpdate;
import io.furrow.analytics.collision.grid.Grid;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.collision.rules.RestoredRules;
import io.furrow.analytics.eventtime.EventTimeOperator;

/**
 * Finds the close pairs of each grid cell. Key: the cell's id.
 *
 * <p><b>State</b>: updates that wait for the watermark, the devices in the cell and around it with the shortlists of those in crowds, the
 * last report of crowds if within a minute.
 *
 * <p><b>Cleared</b>: when the last device has left, no update waits and no crowd is to be reported; all of it when restored with changed
 * rules.
 *
 * <p><b>Late</b>: impossible; the previous stage acts before it forwards a watermark.
 *
 * <p><b>Emits</b>: an observation for each instant at which a followed pair is or was close and either device reported or left. Crowds go
 * to {@link #OVERFLOWS}; {@code pairsLeftOut} counts the pairs without an encounter that these report.
 */
public final class MatchPairs extends EventTimeOperator<Long, CellUpdate, Cell, PairObservation> {
    public static final OutputTag<CellOverflow> OVERFLOWS = new OutputTag<>("overflows") {
        private static final long serialVersionUID = 1L;
    };

    private static final long serialVersionUID = 1L;

    private final PairSelection pairSelection;
    private final ReportCrowds crowds;

    private final CollisionRules rules;

    private transient RestoredRules restored;
    private transient Counter leftOut;
    private transient Consumer<CellOverflow> overflows;

    public MatchPairs(CollisionRules rules) {
        super(new PendingUpdatesSerializer());
        this.rules = rules.exact();
        pairSelection = new PairSelection(this.rules);
        crowds = new ReportCrowds(pairSelection, new Grid(this.rules));
    }

    @Override
    protected Comparator<CellUpdate> sequence() {
        return CellUpdate.SEQUENCE;
    }

    @Override
    public void initializeState(StateInitializationContext context) throws Exception {
        super.initializeState(context);
        restored = RestoredRules.of(context.getOperatorStateStore(), rules);
    }

    @Override
    public void open() throws Exception {
        super.open();
        if (restored.changed()) {
            forget(true, (cell, out) -> {});
        }
        leftOut = getMetricGroup().counter("pairsLeftOut");
        overflows = overflow -> {
            leftOut.inc(overflow.pairsLeftOut());
            output.collect(OVERFLOWS, new StreamRecord<>(overflow));
        };
    }

    @Override
    protected Cell apply(Long id, Cell before, List<CellUpdate> due, long until, Collector<PairObservation> out) {
        Cell now = before == null ? Cell.empty() : before;
        int from = 0;
        while (from < due.size()) {
            int to = Cell.endOfInstant(due, from);
            long time = due.get(from).time();
            crowds.advance(id, now, time - 1, overflows);
            now.applyAtOnce(due.subList(from, to), pairSelection, out::collect);
            crowds.applied(id, now, time, overflows);
            from = to;
        }
        crowds.advance(id, now, until, overflows);
        return now.isEmpty() ? null : now;
    }

    @Override
    public void snapshotState(StateSnapshotContext context) throws Exception {
        super.snapshotState(context);
        restored.snapshot();
    }

    /** The next full minute of a crowd report. */
    @Override
    protected long expiry(Cell cell) {
        return cell.report() == null ? NEVER : cell.report().next();
    }
}
