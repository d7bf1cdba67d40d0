package io.furrow.analytics.collision;

import java.io.Serializable;
import java.util.List;
import java.util.Optional;
import java.util.function.Consumer;

/**
 * Joins what all cells saw of one pair into encounters. A pair is close in no cell or in one: the changes of all cells at
 * one instant sum up to a start, an end, or a hand-over between cells, which is neither.
 */
final class Follower implements Serializable {
    private static final long serialVersionUID = 1L;

    private final long ongoingEvery;

    Follower(CollisionRules rules) {
        ongoingEvery = rules.ongoingEvery().toMillis();
    }

    /** What a pair's sightings come to; {@code violations} counts instants that no grid could have brought about. */
    record Followed(Optional<Meeting> meeting, int violations) {}

    /**
     * Follows a pair through its sightings.
     *
     * @param sightings in the order of {@link Sighting#SEQUENCE}
     * @param out takes the records in the order of time
     */
    Followed follow(Optional<Meeting> before, List<Sighting> sightings, Consumer<Encounter> out) {
        Optional<Meeting> meeting = before;
        int violations = 0;
        int from = 0;
        while (from < sightings.size()) {
            long time = sightings.get(from).time();
            int to = from;
            int close = meeting.isPresent() ? 1 : 0;
            Sighting here = null;
            Sighting gone = null;
            for (; to < sightings.size() && sightings.get(to).time() == time; to++) {
                Sighting sighting = sightings.get(to);
                close += sighting.change();
                here = sighting.change() >= 0 ? sighting : here;
                gone = sighting.change() < 0 ? sighting : gone;
            }
            violations += close == (here == null ? 0 : 1) ? 0 : 1;
            meeting = here != null ? Optional.of(seen(meeting, here, out)) : ended(meeting, gone, out);
            from = to;
        }
        return new Followed(meeting, violations);
    }

    private Meeting seen(Optional<Meeting> before, Sighting sighting, Consumer<Encounter> out) {
        double distance = Geodesy.distance(sighting.first(), sighting.second());
        if (before.isEmpty()) {
            Meeting meeting = new Meeting(sighting.time(), distance, sighting.time());
            out.accept(encounter(Phase.STARTED, meeting, sighting, distance));
            return meeting;
        }
        Meeting known = before.get();
        boolean report = sighting.time() - known.reported() >= ongoingEvery;
        Meeting meeting = new Meeting(
                known.startTime(),
                Math.min(known.minDistance(), distance),
                report ? sighting.time() : known.reported());
        if (report) {
            out.accept(encounter(Phase.ONGOING, meeting, sighting, distance));
        }
        return meeting;
    }

    private static Optional<Meeting> ended(Optional<Meeting> meeting, Sighting gone, Consumer<Encounter> out) {
        meeting.ifPresent(known ->
                out.accept(encounter(Phase.ENDED, known, gone, Geodesy.distance(gone.first(), gone.second()))));
        return Optional.empty();
    }

    private static Encounter encounter(Phase phase, Meeting meeting, Sighting sighting, double distance) {
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
