package io.furrow.analytics.collision.rules;

import java.io.Serializable;

/**
 * The division of the Earth into cells.
 *
 * @param meters height of a cell; except in crowds it affects only speed, not results
 * @param crowd a device with more close devices than this follows only the nearest; 0 follows all
 */
public record CellRules(double meters, int crowd) implements Serializable {
    /** Cells of this many thresholds yield about 1.1 copies of each position. */
    public static final double THRESHOLDS = 20;

    /** More machines than fit within 5 m. */
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
