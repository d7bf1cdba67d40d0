package io.furrow.analytics.collision.matching;

import java.io.Serializable;
import java.time.Duration;

import org.apache.flink.api.common.typeinfo.TypeInfo;

import io.furrow.analytics.collision.CollisionRules;
import io.furrow.analytics.collision.debounce.DebounceRules;
import io.furrow.analytics.collision.grid.CellRules;
import io.furrow.analytics.collision.position.PositionRules;

/**
 * The rules by which state was made, as that state keeps them.
 *
 * @param thresholds up to which distance two devices are close
 * @param maxSkewMillis how far apart in time the positions of a close pair may be; 0 for any
 * @param timeToLiveMillis how long a position counts
 * @param cellMeters height of a cell
 * @param crowd of a device with more others close to it than this only the nearest are followed; 0 follows all
 * @param zones hash of the exclusion zones
 */
@TypeInfo(KnownRulesSerializer.class)
public record KnownRules(
        Thresholds thresholds, long maxSkewMillis, long timeToLiveMillis, double cellMeters, int crowd, int zones)
        implements Serializable {
    /** Those of the exact stages. */
    public static KnownRules of(CollisionRules rules) {
        return new KnownRules(
                rules.thresholds(),
                rules.maxSkew().toMillis(),
                rules.timeToLive().toMillis(),
                rules.cellMeters(),
                rules.cells().crowd(),
                rules.positions().zones().toString().hashCode());
    }

    /** The rules but for the zones, which no cell asks for. */
    CollisionRules inCells() {
        return new CollisionRules(
                thresholds,
                new PositionRules(
                        Duration.ofMillis(timeToLiveMillis), Duration.ofMillis(maxSkewMillis), ExclusionZones.NONE),
                DebounceRules.NONE,
                Duration.ZERO,
                new CellRules(cellMeters, crowd));
    }
}
