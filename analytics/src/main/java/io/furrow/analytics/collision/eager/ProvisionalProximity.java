package io.furrow.analytics.collision.eager;

import org.apache.flink.api.common.typeinfo.TypeInfo;

import io.furrow.analytics.collision.encounter.Pair;
import io.furrow.analytics.position.PositionFix;

/**
 * What one grid cell saw of a pair by what has arrived.
 *
 * @param first where the one device is, in the order of {@link PositionFix#NAMING}; where not close, where it was
 * @param second where the other is, or was
 * @param firstVersion of the first device, to the knowledge of the cell
 * @param secondVersion of the second
 * @param close whether they are close in this cell
 */
@TypeInfo(ProvisionalProximitySerializer.class)
public record ProvisionalProximity(
        PositionFix first, PositionFix second, long firstVersion, long secondVersion, boolean close) {
    public Pair pair() {
        return Pair.of(first, second);
    }
}
