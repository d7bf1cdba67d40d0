package io.furrow.analytics.collision;

import java.io.Serializable;
import java.util.function.Consumer;

/** What becomes of the encounters of a pair behind the exact stages: hysteresis, then dwell, then the rate of records. */
final class Steadier implements Serializable {
    private static final long serialVersionUID = 1L;

    private final Hysteresis hysteresis;
    private final Dwell dwell;
    private final long ongoingEvery;

    Steadier(CollisionRules rules) {
        hysteresis = new Hysteresis(rules);
        dwell = new Dwell(rules);
        ongoingEvery = rules.ongoingEvery().toMillis();
    }

    /** When {@link #advance} has something to tell if nothing is seen until then; null where it has not. */
    Long due(Course course) {
        return course == null || course.told() ? null : Long.valueOf(dwell.due(course.newest()));
    }

    /**
     * @param before null where the pair is not close
     * @param seen what the exact stages tell of it next
     * @return null where it is close no more
     */
    Course next(Course before, Encounter seen, Consumer<Encounter> out) {
        Course known = advance(before, seen.time() - 1, out);
        Encounter now = hysteresis.next(known == null ? null : known.newest(), seen);
        if (now == null) {
            return null;
        }
        if (now.phase() == Phase.ENDED) {
            if (known.told()) {
                out.accept(now);
            }
            return null;
        }
        if (known == null || !known.told()) {
            return dwell.advance(new Course(now, false, 0), now.time(), out);
        }
        boolean report = now.time() - known.reported() >= ongoingEvery;
        if (report) {
            out.accept(now);
        }
        return new Course(now, true, report ? now.time() : known.reported());
    }

    /** Everything of the pair up to an instant has been seen. */
    Course advance(Course course, long until, Consumer<Encounter> out) {
        return course == null ? null : dwell.advance(course, until, out);
    }
}
