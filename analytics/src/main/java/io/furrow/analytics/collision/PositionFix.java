package io.furrow.analytics.collision;

import java.util.Comparator;

import io.furrow.model.event.FiwareScope;

/**
 * Where a device was at an instant. Texts are empty, never null, where nothing is known.
 *
 * @param identity tenant, service path and id: what makes the device unique
 * @param id the entity id
 * @param mission the mission it works for
 * @param carrier identity of the device that carries it
 * @param latitude degrees, −90 to 90
 * @param longitude degrees, −180 to 180
 * @param time epoch milliseconds
 */
public record PositionFix(
        String identity, String id, String mission, String carrier, double latitude, double longitude, long time)
        implements Timed {
    /** The order in which a pair is named: by id, then by identity. */
    static final Comparator<PositionFix> NAMING =
            Comparator.comparing(PositionFix::id).thenComparing(PositionFix::identity);

    /** By time; of two fixes of one device and instant the later in this order counts. */
    static final Comparator<PositionFix> SEQUENCE = Comparator.comparingLong(PositionFix::time)
            .thenComparingDouble(PositionFix::latitude)
            .thenComparingDouble(PositionFix::longitude)
            .thenComparing(PositionFix::mission)
            .thenComparing(PositionFix::carrier);

    /** The tenant and service path that the identity begins with. */
    FiwareScope scope() {
        String[] parts = identity.split("\\|", 3);
        return new FiwareScope(parts[0], parts[1]);
    }

    /** Whether both are parts of one aggregate: one carries the other, or a third carries both. */
    boolean sharesAggregateWith(PositionFix other) {
        return carrier.equals(other.identity)
                || other.carrier.equals(identity)
                || !carrier.isEmpty() && carrier.equals(other.carrier);
    }
}
