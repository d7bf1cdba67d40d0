package io.furrow.analytics.collision;

import java.io.Serializable;

/**
 * How the Earth is cut into cells.
 *
 * @param meters height of a cell; without a limit no result depends on it, only speed
 * @param pairLimit how many pairs of one cell are followed at once; 0 for all
 */
public record CellRules(double meters, int pairLimit) implements Serializable {
    /** Cells of this many thresholds keep about 1.1 copies of each position. */
    static final double THRESHOLDS = 20;

    public CellRules {
        if (!(meters > 0 && Double.isFinite(meters))) {
            throw new IllegalArgumentException("the cell must be at least as high as the threshold, not " + meters);
        }
        if (pairLimit < 0) {
            throw new IllegalArgumentException("the limit of pairs must not be negative: " + pairLimit);
        }
    }

    boolean isLimited() {
        return pairLimit > 0;
    }
}
