package io.furrow.analytics.collision;

import org.apache.flink.api.common.typeinfo.TypeInfo;

/**
 * What one grid cell saw of a pair by what has arrived.
 *
 * @param first where the one device is, in the order of {@link PositionFix#NAMING}; where not close, where it was
 * @param second where the other is, or was
 * @param firstVersion of the first device, to the knowledge of the cell
 * @param secondVersion of the second
 * @param close whether they are close in this cell
 */
@TypeInfo(GlimpseFormat.class)
public record Glimpse(PositionFix first, PositionFix second, long firstVersion, long secondVersion, boolean close) {
    Pair pair() {
        return Pair.of(first, second);
    }
}
