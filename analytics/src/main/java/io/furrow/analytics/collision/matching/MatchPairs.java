package io.furrow.analytics.collision.matching;

import java.util.Comparator;
import java.util.List;
import java.util.function.Consumer;

import org.apache.flink.api.common.state.ListState;
import org.apache.flink.api.common.state.ListStateDescriptor;
import org.apache.flink.api.common.state.OperatorStateStore;
import org.apache.flink.metrics.Counter;
import org.apache.flink.runtime.state.StateInitializationContext;
import org.apache.flink.runtime.state.StateSnapshotContext;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.util.Collector;
import org.apache.flink.util.OutputTag;

import io.furrow.analytics.collision.CollisionRules;
import io.furrow.analytics.collision.encounter.PairObservation;
import io.furrow.analytics.collision.grid.Cell;
import io.furrow.analytics.collision.grid.CellUpdate;
import io.furrow.analytics.collision.grid.Grid;
import io.furrow.analytics.collision.grid.PendingUpdatesSerializer;
import io.furrow.analytics.eventtime.EventTimeOperator;
import io.furrow.flink.format.FormatType;
import io.furrow.flink.time.EventTimeReached;

/**
 * Finds the close pairs of each grid cell. Key: the cell's id.
 *
 * <p><b>State</b>: updates that wait for the watermark, the devices in the cell and around it with the shortlists of those in
 * crowds, what was notified of crowds within the last minute; per subtask how far event time has come and the rules, because
 * restored with others it must know who was close by those of before.
 *
 * <p><b>Cleared</b>: when the last device has gone, no update waits and there is nothing to report a crowd.
 *
 * <p><b>Late</b>: nothing can be, the stage before acts before it forwards a watermark.
 *
 * <p><b>Emits</b>: a sighting for each instant at which a pair that is followed is or was close and either device reported or
 * left. Crowds go to {@link #OVERFLOWS}; {@code pairsLeftOut} counts the pairs without an encounter that these report.
 */
public final class MatchPairs extends EventTimeOperator<Long, CellUpdate, Cell, PairObservation> {
    public static final OutputTag<CellOverflow> OVERFLOWS = new OutputTag<>("overflows") {
        private static final long serialVersionUID = 1L;
    };

    private static final long serialVersionUID = 1L;

    private final Matching matching;
    private final ReportCrowds crowds;

    private final KnownRules rules;

    private transient ListState<RulesUntil> knownRules;
    private transient MatchingHistory history;
    private transient EventTimeReached reached;
    private transient Counter leftOut;
    private transient Consumer<CellOverflow> overflows;

    public MatchPairs(CollisionRules rules) {
        super(new PendingUpdatesSerializer());
        this.rules = KnownRules.of(rules.exact());
        matching = new Matching(rules.exact());
        crowds = new ReportCrowds(matching, new Grid(rules.exact()));
    }

    @Override
    protected Comparator<CellUpdate> sequence() {
        return CellUpdate.SEQUENCE;
    }

    @Override
    public void initializeState(StateInitializationContext context) throws Exception {
        super.initializeState(context);
        OperatorStateStore store = context.getOperatorStateStore();
        reached = EventTimeReached.restore(store, getRuntimeContext().getTaskInfo());
        knownRules = store.getUnionListState(
                new ListStateDescriptor<>("rules", new FormatType<>(new RulesUntilSerializer())));
        history = new MatchingHistory(rules, matching);
        history.restore(knownRules.get(), reached.furthest());
    }

    @Override
    public void open() throws Exception {
        super.open();
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
            now.applyAtOnce(due.subList(from, to), history.before(time), history.from(time), out::collect);
            if (now.devices() == 0 && history.isTurn(time)) {
                now.report(null); // a cell of the grid that was
            }
            crowds.applied(id, now, time, overflows);
            from = to;
        }
        crowds.advance(id, now, until, overflows);
        return now.isEmpty() ? null : now;
    }

    @Override
    public void processWatermark(Watermark mark) throws Exception {
        super.processWatermark(mark);
        reached.advance(mark.getTimestamp());
        history.passed(mark.getTimestamp());
    }

    @Override
    public void snapshotState(StateSnapshotContext context) throws Exception {
        super.snapshotState(context);
        reached.snapshot();
        knownRules.update(history.toSave());
    }

    /** When the next minute is full. */
    @Override
    protected long expiry(Cell cell) {
        return cell.report() == null ? NEVER : cell.report().next();
    }
}
