package io.furrow.analytics.collision.rules;

import java.io.Serializable;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.UUID;

/**
 * The rules by which encounters are detected and reported.
 *
 * @param thresholds up to which distance two devices are close
 * @param positions which positions count
 * @param steadiness debouncing
 * @param ongoingEvery least event time between two records of a lasting encounter; zero reports every observation
 * @param cells how the Earth is divided into cells, each at least as high as the threshold at which encounters end
 */
public record CollisionRules(
        Thresholds thresholds,
        PositionRules positions,
        DebounceRules steadiness,
        Duration ongoingEvery,
        CellRules cells)
        implements Serializable {
    /** 5 m, 30 s, any skew, a record a second, cells of 20 thresholds, crowds beyond 64 others. */
    public static final CollisionRules DEFAULT =
            new CollisionRules(5, Duration.ofSeconds(30), Duration.ZERO, Duration.ofSeconds(1), 100);

    public CollisionRules {
        if (ongoingEvery.isNegative()) {
            throw new IllegalArgumentException(
                    "the time between ongoing records must not be negative: " + ongoingEvery);
        }
        double reach = thresholds.times(steadiness.leaveFactor()).greatest();
        if (cells.meters() < reach) {
            throw new IllegalArgumentException("the cell must be at least as high as the threshold at which encounters "
                    + "end, " + reach + " meters, not " + cells.meters());
        }
    }

    /** One threshold for all types, no zones, no debouncing, the default crowd limit. */
    public CollisionRules(
            double thresholdMeters, Duration timeToLive, Duration maxSkew, Duration ongoingEvery, double cellMeters) {
        this(
                Thresholds.of(thresholdMeters),
                new PositionRules(timeToLive, maxSkew, ExclusionZones.NONE),
                DebounceRules.NONE,
                ongoingEvery,
                new CellRules(cellMeters, CellRules.CROWD));
    }

    public CollisionRules with(Thresholds other) {
        return new CollisionRules(other, positions, steadiness, ongoingEvery, cells);
    }

    public CollisionRules with(PositionRules other) {
        return new CollisionRules(thresholds, other, steadiness, ongoingEvery, cells);
    }

    public CollisionRules with(DebounceRules other) {
        return new CollisionRules(thresholds, positions, other, ongoingEvery, cells);
    }

    public CollisionRules with(CellRules other) {
        return new CollisionRules(thresholds, positions, steadiness, ongoingEvery, other);
    }

    /** The rules of the exact stages when debouncing follows: wider thresholds, every observation. */
    public CollisionRules exact() {
        return steadiness.isNone()
                ? this
                : new CollisionRules(
                        thresholds.times(steadiness.leaveFactor()),
                        positions,
                        DebounceRules.NONE,
                        Duration.ZERO,
                        cells);
    }

    /** Equal for rules by which the same pairs are close, in this and in another JVM. */
    String digest() {
        String rules = thresholds + " " + positions + " " + cells;
        return UUID.nameUUIDFromBytes(rules.getBytes(StandardCharsets.UTF_8)).toString();
    }

    /** The greatest threshold of any pair. */
    public double thresholdMeters() {
        return thresholds.greatest();
    }

    public Duration timeToLive() {
        return positions.timeToLive();
    }

    public Duration maxSkew() {
        return positions.maxSkew();
    }

    public double cellMeters() {
        return cells.meters();
    }
}
