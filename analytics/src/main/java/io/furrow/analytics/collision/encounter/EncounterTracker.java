package io.furrow.analytics.collision.encounter;

import java.io.Serializable;
import java.util.List;
import java.util.function.Consumer;

import io.furrow.analytics.collision.grid.Geodesy;
import io.furrow.analytics.collision.rules.CollisionRules;

/**
 * Joins what all cells saw of one pair into encounters. A pair is close in no cell or in one: the changes of all cells at
 * one instant sum up to a start, an end, or a hand-over between cells, which is neither.
 */
public final class EncounterTracker implements Serializable {
    private static final long serialVersionUID = 1L;

    private final long ongoingEvery;

    public EncounterTracker(CollisionRules rules) {
        ongoingEvery = rules.ongoingEvery().toMillis();
    }

    /**
     * What a pair's sightings come to.
     *
     * @param meeting null while the pair is not close
     * @param violations instants that no grid could have brought about
     */
    public record Followed(OpenEncounter meeting, int violations) {}

    /**
     * Follows a pair through its sightings.
     *
     * @param before null while the pair is not close
     * @param sightings in the order of {@link PairObservation#SEQUENCE}
     * @param out takes the records in the order of time
     */
    public Followed follow(OpenEncounter before, List<PairObservation> sightings, Consumer<Encounter> out) {
        OpenEncounter meeting = before;
        int violations = 0;
        int from = 0;
        while (from < sightings.size()) {
            long time = sightings.get(from).time();
            int to = from;
            int close = meeting != null ? 1 : 0;
            PairObservation here = null;
            PairObservation gone = null;
            for (; to < sightings.size() && sightings.get(to).time() == time; to++) {
                PairObservation sighting = sightings.get(to);
                close += sighting.change();
                here = sighting.change() >= 0 ? sighting : here;
                gone = sighting.change() < 0 ? sighting : gone;
            }
            violations += close == (here == null ? 0 : 1) ? 0 : 1;
            meeting = here != null ? seen(meeting, here, out) : ended(meeting, gone, out);
            from = to;
        }
        return new Followed(meeting, violations);
    }

    private OpenEncounter seen(OpenEncounter known, PairObservation sighting, Consumer<Encounter> out) {
        double distance = Geodesy.distance(sighting.first(), sighting.second());
        if (known == null) {
            OpenEncounter meeting =
                    new OpenEncounter(sighting.time(), distance, sighting.time(), sighting.first(), sighting.second());
            out.accept(encounter(Phase.STARTED, meeting, sighting, distance));
            return meeting;
        }
        boolean report = sighting.time() - known.reported() >= ongoingEvery;
        OpenEncounter meeting = new OpenEncounter(
                known.startTime(),
                Math.min(known.minDistance(), distance),
                report ? sighting.time() : known.reported(),
                sighting.first(),
                sighting.second());
        if (report) {
            out.accept(encounter(Phase.ONGOING, meeting, sighting, distance));
        }
        return meeting;
    }

    private static OpenEncounter ended(OpenEncounter known, PairObservation gone, Consumer<Encounter> out) {
        if (known != null) {
            out.accept(encounter(Phase.ENDED, known, gone, Geodesy.distance(gone.first(), gone.second())));
        }
        return null;
    }

    /** The end of an encounter by other rules, at the newest of its positions. */
    static Encounter cutOff(OpenEncounter open) {
        long time = Math.max(open.first().time(), open.second().time());
        PairObservation last = new PairObservation(open.first(), open.second(), time, -1);
        return encounter(Phase.ENDED, open, last, Geodesy.distance(open.first(), open.second()));
    }

    private static Encounter encounter(Phase phase, OpenEncounter meeting, PairObservation sighting, double distance) {
        return new Encounter(
                phase,
                sighting.first(),
                sighting.second(),
                distance,
                meeting.minDistance(),
                meeting.startTime(),
                sighting.time());
    }
}
