package io.furrow.analytics.collision.debounce;

import java.io.Serializable;

import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.collision.rules.Thresholds;

/**
 * Delays the start of an encounter to the threshold of its pair where the exact stages found it at a greater distance:
 * from the first instant at which the devices are within the threshold until the exact stages see the end.
 */
final class Hysteresis implements Serializable {
    private static final long serialVersionUID = 1L;

    private final Thresholds thresholds;

    Hysteresis(CollisionRules rules) {
        thresholds = rules.thresholds();
    }

    /**
     * @param running what this gave for the pair's record before; null if nothing is under way
     * @param seen what the exact stages emit next for the pair
     * @return null if the pair has not been within the threshold
     */
    Encounter next(Encounter running, Encounter seen) {
        if (running != null) {
            double closest = Math.min(running.minDistance(), seen.distance());
            return record(seen, seen.phase(), closest, running.startTime());
        }
        double threshold = thresholds.between(seen.first().type(), seen.second().type());
        boolean starts = seen.phase() != Phase.ENDED && seen.distance() <= threshold;
        return starts ? record(seen, Phase.STARTED, seen.distance(), seen.time()) : null;
    }

    private static Encounter record(Encounter seen, Phase phase, double closest, long start) {
        return seen.of(phase, seen.distance(), closest, start, seen.time());
    }
}
