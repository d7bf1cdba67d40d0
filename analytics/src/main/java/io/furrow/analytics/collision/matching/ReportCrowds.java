package io.furrow.analytics.collision.matching;

import java.io.Serializable;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.function.Consumer;

import io.furrow.analytics.collision.grid.Grid;
import io.furrow.analytics.position.PositionFix;

/**
 * Reports the crowds of a grid cell: at the first instant at which a device has a shortlist, then each minute of event time
 * while one has, and once, also at a full minute, when none has any longer. A report shows the state of its instant, so that it
 * is the same whatever the watermarks.
 */
public final class ReportCrowds implements Serializable {
    private static final long serialVersionUID = 1L;
    /** Selects the member with a shortlist whose position and scope the report of a cell has. */
    private static final Comparator<CellEntry> BY_NAME = Comparator.comparing(
                    CellEntry::resident, Comparator.reverseOrder())
            .thenComparing(CellEntry::fix, PositionFix.NAMING);

    private final PairSelection pairSelection;
    private final Grid grid;

    public ReportCrowds(PairSelection pairSelection, Grid grid) {
        this.pairSelection = pairSelection;
        this.grid = grid;
    }

    /** Reports all full minutes up to an instant, after its updates, if any, have been applied. */
    public void advance(long id, Cell cell, long until, Consumer<CellOverflow> out) {
        while (cell.report() != null && cell.report().next() <= until) {
            CrowdReport report = cell.report();
            if (cell.isCrowded() || report.over()) {
                tell(id, cell, report.next(), out);
            } else {
                cell.report(null);
            }
        }
    }

    /** Reports a new crowd after the updates of an instant have been applied. */
    public void applied(long id, Cell cell, long time, Consumer<CellOverflow> out) {
        if (cell.isCrowded() && cell.report() == null) {
            tell(id, cell, time, out);
        }
    }

    private void tell(long id, Cell cell, long time, Consumer<CellOverflow> out) {
        PositionFix witness = cell.members().stream()
                .filter(cellEntry -> cellEntry.shortlist() != null)
                .min(BY_NAME)
                .map(CellEntry::fix)
                .orElseGet(() -> cell.report().witness());
        out.accept(describe(id, cell, witness, time));
        cell.report(new CrowdReport(time, cell.isCrowded(), witness));
    }

    /** Goes through all pairs of the cell, once a minute. */
    private CellOverflow describe(long id, Cell cell, PositionFix witness, long time) {
        long ends = 0;
        long followed = 0;
        int most = 0;
        List<CellEntry> near = new ArrayList<>();
        for (CellEntry cellEntry : cell.members()) {
            cell.near(cellEntry, pairSelection.proximity(), near);
            most = Math.max(most, near.size());
            for (CellEntry other : near) {
                if (PairSelection.meet(cellEntry, other)) {
                    ends++;
                    followed += PairSelection.follows(cellEntry, other) ? 1 : 0;
                }
            }
            near.clear();
        }
        double[] center = grid.center(id);
        return new CellOverflow(
                witness,
                id,
                center[0],
                center[1],
                cell.devices(),
                ends / 2,
                (ends - followed) / 2,
                pairSelection.chosenOf(most),
                time);
    }
}
