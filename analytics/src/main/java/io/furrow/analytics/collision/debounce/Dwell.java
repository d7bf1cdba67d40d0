package io.furrow.analytics.collision.debounce;

import java.io.Serializable;
import java.util.function.Consumer;

import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.collision.rules.CollisionRules;

/**
 * Emits an encounter once it has lasted for the dwell: at exactly that instant, with where both were last seen, and
 * unless it ends at that instant. What ends sooner is never emitted.
 */
final class Dwell implements Serializable {
    private static final long serialVersionUID = 1L;

    private final long millis;

    Dwell(CollisionRules rules) {
        millis = rules.steadiness().dwell().toMillis();
    }

    /** When the start of an encounter is emitted if it lasts. */
    long due(Encounter encounter) {
        return encounter.startTime() + millis;
    }

    /**
     * Emits the start if its instant has come.
     *
     * @param until everything of the pair up to this instant has been seen
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
