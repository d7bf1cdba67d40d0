package io.furrow.analytics.collision.debounce;

import java.io.Serializable;

import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.collision.rules.Thresholds;

/**
 * Delays the start of an encounter that the exact stages found beyond the pair's threshold: it lasts from the first
 * instant at which the devices are within the threshold until the exact stages see the end.
 */
final class Hysteresis implements Serializable {
    private static final long serialVersionUID = 1L;

    private final Thresholds thresholds;

    Hysteresis(CollisionRules rules) {
        thresholds = rules.thresholds();
    }

    /**
     * @param running the previous result for the pair; null if there is no encounter
     * @param seen the next record of the exact stages for the pair
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
