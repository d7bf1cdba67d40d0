package io.furrow.analytics.collision.encounter;

import java.io.Serializable;
import java.util.List;
import java.util.function.Consumer;

import io.furrow.analytics.collision.grid.Geodesy;
import io.furrow.analytics.collision.rules.CollisionRules;

/**
 * Joins the observations of one pair in all cells into encounters. A pair is close in at most one cell: the changes of
 * all cells at one instant add up to a start, an end, or neither when one cell replaces another.
 */
public final class EncounterTracker implements Serializable {
    private static final long serialVersionUID = 1L;

    private final long ongoingEvery;

    public EncounterTracker(CollisionRules rules) {
        ongoingEvery = rules.ongoingEvery().toMillis();
    }

    /**
     * The result of applying a pair's observations.
     *
     * @param encounter null while the pair is not close
     * @param violations number of contradictory instants, which no grid could produce
     */
    public record Followed(OpenEncounter encounter, int violations) {}

    /**
     * Applies a pair's observations.
     *
     * @param before null while the pair is not close
     * @param observations in the order of {@link PairObservation#SEQUENCE}
     * @param out receives the records in order of time
     */
    public Followed follow(OpenEncounter before, List<PairObservation> observations, Consumer<Encounter> out) {
        OpenEncounter encounter = before;
        int violations = 0;
        int from = 0;
        while (from < observations.size()) {
            long time = observations.get(from).time();
            int to = from;
            int close = encounter != null ? 1 : 0;
            PairObservation here = null;
            PairObservation gone = null;
            for (; to < observations.size() && observations.get(to).time() == time; to++) {
                PairObservation observation = observations.get(to);
                close += observation.change();
                here = observation.change() >= 0 ? observation : here;
                gone = observation.change() < 0 ? observation : gone;
            }
            violations += close == (here == null ? 0 : 1) ? 0 : 1;
            encounter = here != null ? seen(encounter, here, out) : ended(encounter, gone, out);
            from = to;
        }
        return new Followed(encounter, violations);
    }

    private OpenEncounter seen(OpenEncounter known, PairObservation observation, Consumer<Encounter> out) {
        double distance = Geodesy.distance(observation.first(), observation.second());
        if (known == null) {
            OpenEncounter encounter = new OpenEncounter(
                    observation.time(), distance, observation.time(), observation.first(), observation.second());
            out.accept(encounter(Phase.STARTED, encounter, observation, distance));
            return encounter;
        }
        boolean report = observation.time() - known.reported() >= ongoingEvery;
        OpenEncounter encounter = new OpenEncounter(
                known.startTime(),
                Math.min(known.minDistance(), distance),
                report ? observation.time() : known.reported(),
                observation.first(),
                observation.second());
        if (report) {
            out.accept(encounter(Phase.ONGOING, encounter, observation, distance));
        }
        return encounter;
    }

    private static OpenEncounter ended(OpenEncounter known, PairObservation gone, Consumer<Encounter> out) {
        if (known != null) {
            out.accept(encounter(Phase.ENDED, known, gone, Geodesy.distance(gone.first(), gone.second())));
        }
        return null;
    }

    /** Ends an encounter because of changed rules, at its newest position. */
    static Encounter cutOff(OpenEncounter open) {
        long time = Math.max(open.first().time(), open.second().time());
        PairObservation last = new PairObservation(open.first(), open.second(), time, -1);
        return encounter(Phase.ENDED, open, last, Geodesy.distance(open.first(), open.second()));
    }

    private static Encounter encounter(
            Phase phase, OpenEncounter encounter, PairObservation observation, double distance) {
        return new Encounter(
                phase,
                observation.first(),
                observation.second(),
                distance,
                encounter.minDistance(),
                encounter.startTime(),
                observation.time());
    }
}
