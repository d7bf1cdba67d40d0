package io.furrow.analytics.collision;

import java.util.HashSet;
import java.util.Set;

/**
 * What is remembered of a cell whose pairs are limited.
 *
 * @param kept the pairs that are followed; changed in place
 * @param close how many pairs are close, followed or not
 * @param over whether pairs were left out when it was last looked at
 * @param reported event time of the newest report
 */
public record Crowd(Set<Pair> kept, int close, boolean over, long reported) {
    boolean isEmpty() {
        return close == 0 && kept.isEmpty() && !over;
    }

    Crowd copy() {
        return new Crowd(new HashSet<>(kept), close, over, reported);
    }

    int leftOut() {
        return close - kept.size();
    }

    /**
     * What there is to tell of the cell.
     *
     * @param cause a pair that was seen there; at least one of it was at home in the cell
     */
    CellOverflow overflow(Sighting cause, int devices, long cell, Grid grid) {
        boolean firstIsAtHome =
                grid.cells(cause.first().latitude(), cause.first().longitude())[0] == cell;
        PositionFix inside = firstIsAtHome ? cause.first() : cause.second();
        double[] centre = grid.centre(inside.latitude(), inside.longitude());
        return new CellOverflow(inside, cell, centre[0], centre[1], devices, close, leftOut(), cause.time());
    }
}
