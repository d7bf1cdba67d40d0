package io.furrow.analytics.collision.encounter;

import java.util.Comparator;

import org.apache.flink.api.common.typeinfo.TypeInfo;

import io.furrow.analytics.eventtime.HasEventTime;
import io.furrow.analytics.position.PositionFix;

/**
 * What one grid cell saw of a pair at an instant at which either device reported or left.
 *
 * @param first where the one device is, in the order of {@link PositionFix#NAMING}; after a change of −1, where it was
 * @param second where the other is, or was
 * @param time epoch milliseconds
 * @param change +1 close in this cell from now on, −1 no more, 0 still
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
