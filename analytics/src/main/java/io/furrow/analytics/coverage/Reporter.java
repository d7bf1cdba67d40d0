package io.furrow.analytics.coverage;

import java.io.Serializable;

import io.furrow.analytics.coverage.CoverageState.Sample;
import io.furrow.flink.record.Epochs;

/** Computes reports of coverages, at multiples of an interval of original time. */
final class Reporter implements Serializable {
    /** Interval of which the newest end is measured for the rate, ms. */
    static final long RATE_WINDOW = 600_000;

    private static final long serialVersionUID = 1L;
    private static final double MILLIS_PER_HOUR = 3_600_000;
    /** Longer stretches without a covered cell are left to do, meters in working widths. */
    private static final double GAP_WIDTHS = 2;
    /** Maximum number of cells of a layer. */
    private static final int MAX_LAYER_CELLS = 1 << 18;

    private final long every;

    /** @param every interval, ms */
    Reporter(long every) {
        this.every = every;
    }

    /** The first report that includes an event. */
    long next(long time) {
        return Epochs.begin(time) + (Epochs.original(time) + every - 1) / every * every;
    }

    CoverageReport report(CoverageState state, long time, FieldGrid grid, CoveredCells cells) throws Exception {
        boolean ofAll = !state.last().ofRobot();
        CellClasses classes = ofAll ? cells.classes(GAP_WIDTHS * state.width()) : null;
        return new CoverageReport(
                state.last(),
                time,
                state.begin(),
                grid.cell(),
                grid.cells(),
                state.covered(),
                state.overlapped(),
                ofAll ? classes.gaps() : 0,
                perHour(state, time),
                ofAll ? classes.layer(MAX_LAYER_CELLS) : null);
    }

    private static double perHour(CoverageState state, long time) {
        Sample first = state.samples().get(0);
        return time > first.time()
                ? (state.covered() - first.covered()) * MILLIS_PER_HOUR / (time - first.time())
                : Double.NaN;
    }
}
