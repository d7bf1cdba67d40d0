package io.furrow.analytics.collision;

import java.io.Serializable;

/**
 * Lets an encounter start at the threshold of its pair where the exact stages saw it start at a greater distance: from the
 * first instant at which the devices are within the threshold until the exact stages see the end.
 */
final class Hysteresis implements Serializable {
    private static final long serialVersionUID = 1L;

    private final Thresholds thresholds;

    Hysteresis(CollisionRules rules) {
        thresholds = rules.thresholds();
    }

    /**
     * @param running what this gave for the pair's record before; null where nothing is under way
     * @param seen what the exact stages tell next of the pair
     * @return null where the pair has not been within the threshold
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
