package io.furrow.analytics.collision.encounter;

import java.util.Comparator;
import java.util.List;

import org.apache.flink.metrics.Counter;
import org.apache.flink.util.Collector;

import io.furrow.analytics.collision.CollisionRules;
import io.furrow.analytics.eventtime.EventTimeOperator;

/**
 * Emits the life cycle of each encounter: started, ongoing, ended. Key: the pair.
 *
 * <p><b>State</b>: sightings that wait for the watermark; start, closest distance and newest report of an encounter.
 *
 * <p><b>Cleared</b>: when the encounter has ended and no sighting waits.
 *
 * <p><b>Late</b>: nothing can be, the stage before acts before it forwards a watermark.
 *
 * <p><b>Emits</b>: records of encounters, a pair's in the order of their time. Instants at which the cells contradict each
 * other are counted as {@code violations}: always 0 unless the code is wrong.
 */
public final class TrackEncounters extends EventTimeOperator<Pair, PairObservation, OpenEncounter, Encounter> {
    private static final long serialVersionUID = 1L;

    private final EncounterTracker follower;

    private transient Counter violations;

    public TrackEncounters(CollisionRules rules) {
        super(new PendingObservationsSerializer());
        follower = new EncounterTracker(rules.exact());
    }

    @Override
    protected Comparator<PairObservation> sequence() {
        return PairObservation.SEQUENCE;
    }

    @Override
    public void open() throws Exception {
        super.open();
        violations = getMetricGroup().counter("violations");
    }

    @Override
    protected OpenEncounter apply(
            Pair pair, OpenEncounter before, List<PairObservation> due, long until, Collector<Encounter> out) {
        EncounterTracker.Followed followed = follower.follow(before, due, out::collect);
        violations.inc(followed.violations());
        return followed.meeting();
    }
}
