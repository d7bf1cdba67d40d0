package io.furrow.analytics.collision.encounter;

import java.util.Comparator;

import org.apache.flink.api.common.typeinfo.TypeInfo;

import io.furrow.analytics.eventtime.HasEventTime;
import io.furrow.analytics.position.PositionFix;

/**
 * An observation of a pair in one grid cell, at an instant at which either device reported or left.
 *
 * @param first position of the one device, in the order of {@link PositionFix#NAMING}; after a change of −1, its last
 * @param second position, or last position, of the other
 * @param time epoch milliseconds
 * @param change +1 close in this cell from now on, −1 no longer, 0 still
 */
@TypeInfo(PairObservationSerializer.class)
public record PairObservation(PositionFix first, PositionFix second, long time, int change) implements HasEventTime {
    public static final Comparator<PairObservation> SEQUENCE = Comparator.comparingLong(PairObservation::time);

    public static PairObservation of(PositionFix one, PositionFix other, long time, int change) {
        return PositionFix.NAMING.compare(one, other) < 0
                ? new PairObservation(one, other, time, change)
                : new PairObservation(other, one, time, change);
    }

    public Pair pair() {
        return Pair.of(first, second);
    }
}
