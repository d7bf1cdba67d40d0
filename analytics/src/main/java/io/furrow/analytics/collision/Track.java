package io.furrow.analytics.collision;

/**
 * Where a device is and which cells know of it.
 *
 * @param last the newest position that still counts; null where none does
 * @param cells ids of the cells, the home first
 */
public record Track(PositionFix last, long[] cells) {
    static final Track NOWHERE = new Track(null, new long[0]);

    boolean isNowhere() {
        return last == null;
    }
}
