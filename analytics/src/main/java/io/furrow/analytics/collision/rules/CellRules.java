package io.furrow.analytics.collision.rules;

import java.io.Serializable;

/**
 * How the Earth is cut into cells.
 *
 * @param meters height of a cell; but in crowds no result depends on it, only speed
 * @param crowd of a device with more others close to it than this only the nearest are followed; 0 follows all
 */
public record CellRules(double meters, int crowd) implements Serializable {
    /** Cells of this many thresholds keep about 1.1 copies of each position. */
    public static final double THRESHOLDS = 20;

    /** More machines than a yard holds within 5 m. */
    public static final int CROWD = 64;

    public CellRules {
        if (!(meters > 0 && Double.isFinite(meters))) {
            throw new IllegalArgumentException("the cell must be at least as high as the threshold, not " + meters);
        }
        if (crowd < 0) {
            throw new IllegalArgumentException("--crowd must be 0, which follows all, or more: " + crowd);
        }
    }

    public boolean isLimited() {
        return crowd > 0;
    }
}
