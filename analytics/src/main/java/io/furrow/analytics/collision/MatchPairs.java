package io.furrow.analytics.collision;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;

import org.apache.flink.metrics.Counter;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.util.Collector;
import org.apache.flink.util.OutputTag;

import io.furrow.analytics.eventtime.EventTimeOperator;

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
public final class MatchPairs extends EventTimeOperator<Long, CellUpdate, Cell, Sighting> {
    static final OutputTag<CellOverflow> OVERFLOWS = new OutputTag<>("overflows") {
        private static final long serialVersionUID = 1L;
    };

    private static final long serialVersionUID = 1L;

    private final Proximity proximity;
    private final PairLimit limit;
    private final Grid grid;

    private transient Counter leftOut;

    MatchPairs(CollisionRules rules) {
        super(new PendingUpdatesFormat());
        proximity = new Proximity(rules.exact());
        limit = new PairLimit(rules);
        grid = new Grid(rules.exact());
    }

    @Override
    protected Comparator<CellUpdate> sequence() {
        return CellUpdate.SEQUENCE;
    }

    @Override
    public void open() throws Exception {
        super.open();
        leftOut = getMetricGroup().counter("pairs.left-out");
    }

    @Override
    protected Cell apply(Long id, Cell before, List<CellUpdate> due, long until, Collector<Sighting> out) {
        Cell now = before == null ? Cell.empty() : before;
        if (limit.isNone()) {
            now.apply(due, proximity, out::collect);
        } else {
            applyLimited(id, now, due, out);
        }
        return now.isEmpty() ? null : now;
    }

    /** Instant by instant, so that what is told of an instant does not depend on how far the watermark went. */
    private void applyLimited(long id, Cell cell, List<CellUpdate> due, Collector<Sighting> out) {
        int from = 0;
        while (from < due.size()) {
            int to = from + 1;
            while (to < due.size() && due.get(to).time() == due.get(from).time()) {
                to++;
            }
            List<Sighting> seen = new ArrayList<>();
            cell.apply(due.subList(from, to), proximity, seen::add);
            cell.crowd(limit.apply(cell.crowd(), seen, new Limited(id, cell, out)));
            from = to;
        }
    }

    /** Where the pairs of a cell go. */
    private final class Limited implements PairLimit.Output {
        private final long id;
        private final Cell cell;
        private final Collector<Sighting> out;

        Limited(long id, Cell cell, Collector<Sighting> out) {
            this.id = id;
            this.cell = cell;
            this.out = out;
        }

        @Override
        public void sighting(Sighting sighting) {
            out.collect(sighting);
        }

        @Override
        public void overflow(Crowd now, Sighting cause) {
            output.collect(OVERFLOWS, new StreamRecord<>(now.overflow(cause, cell.devices(), id, grid)));
        }

        @Override
        public void leftOut() {
            leftOut.inc();
        }
    }
}
