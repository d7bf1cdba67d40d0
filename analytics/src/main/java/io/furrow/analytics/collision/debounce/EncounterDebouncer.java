package io.furrow.analytics.collision.debounce;

import java.io.Serializable;
import java.util.function.Consumer;

import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.collision.rules.CollisionRules;

/** What becomes of the encounters of a pair behind the exact stages: hysteresis, then dwell, then the rate of records. */
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

    /** When {@link #advance} has something to emit if nothing is seen until then; null if it has not. */
    Long due(SteadyState course) {
        return course == null || course.emitted() ? null : Long.valueOf(dwell.due(course.newest()));
    }

    /**
     * @param before null if the pair is not close
     * @param seen what the exact stages report it next
     * @return null if it is close no more
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

    /** Everything of the pair up to an instant has been seen. */
    public SteadyState advance(SteadyState course, long until, Consumer<Encounter> out) {
        return course == null ? null : dwell.advance(course, until, out);
    }
}
