package io.furrow.analytics.collision.debounce;

import java.io.Serializable;
import java.util.function.Consumer;

import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.collision.rules.CollisionRules;

/**
 * Emits an encounter once it has lasted for the dwell: at exactly that instant, with the last known positions, unless
 * it ends at that instant. A shorter encounter is never emitted.
 */
final class Dwell implements Serializable {
    private static final long serialVersionUID = 1L;

    private final long millis;

    Dwell(CollisionRules rules) {
        millis = rules.steadiness().dwell().toMillis();
    }

    /** The time at which the start of an encounter is emitted if it lasts. */
    long due(Encounter encounter) {
        return encounter.startTime() + millis;
    }

    /**
     * Emits the start if it is due.
     *
     * @param until up to when all records of the pair have been applied
     */
    SteadyState advance(SteadyState course, long until, Consumer<Encounter> out) {
        if (course.emitted() || due(course.newest()) > until) {
            return course;
        }
        Encounter seen = course.newest();
        out.accept(seen.of(Phase.STARTED, seen.distance(), seen.minDistance(), seen.startTime(), due(seen)));
        return new SteadyState(seen, true, due(seen));
    }
}
