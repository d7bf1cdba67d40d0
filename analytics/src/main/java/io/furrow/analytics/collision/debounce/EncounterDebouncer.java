package io.furrow.analytics.collision.debounce;

import java.io.Serializable;
import java.util.function.Consumer;

import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.collision.rules.CollisionRules;

/** Debounces the encounters that the exact stages found for a pair: hysteresis, then dwell, then rate limit. */
public final class EncounterDebouncer implements Serializable {
    private static final long serialVersionUID = 1L;

    private final Hysteresis hysteresis;
    private final Dwell dwell;
    private final long ongoingEvery;

    public EncounterDebouncer(CollisionRules rules) {
        hysteresis = new Hysteresis(rules);
        dwell = new Dwell(rules);
        ongoingEvery = rules.ongoingEvery().toMillis();
    }

    /** When {@link #advance} next emits if no record arrives until then; null for never. */
    Long due(SteadyState course) {
        return course == null || course.emitted() ? null : Long.valueOf(dwell.due(course.newest()));
    }

    /**
     * @param before null if the pair is not close
     * @param seen the next record of the exact stages
     * @return null if the pair is no longer close
     */
    public SteadyState next(SteadyState before, Encounter seen, Consumer<Encounter> out) {
        SteadyState known = advance(before, seen.time() - 1, out);
        Encounter now = hysteresis.next(known == null ? null : known.newest(), seen);
        if (now == null) {
            return null;
        }
        if (now.phase() == Phase.ENDED) {
            if (known.emitted()) {
                out.accept(now);
            }
            return null;
        }
        if (known == null || !known.emitted()) {
            return dwell.advance(new SteadyState(now, false, 0), now.time(), out);
        }
        boolean report = now.time() - known.reported() >= ongoingEvery;
        if (report) {
            out.accept(now);
        }
        return new SteadyState(now, true, report ? now.time() : known.reported());
    }

    /** Advances to an instant up to which all records of the pair have been applied. */
    public SteadyState advance(SteadyState course, long until, Consumer<Encounter> out) {
        return course == null ? null : dwell.advance(course, until, out);
    }
}
