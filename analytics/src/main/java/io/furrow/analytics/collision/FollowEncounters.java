package io.furrow.analytics.collision;

import java.util.Comparator;
import java.util.List;

import org.apache.flink.metrics.Counter;
import org.apache.flink.util.Collector;

import io.furrow.analytics.eventtime.EventTimeOperator;

/**
 * Tells the life of each encounter: started, ongoing, ended. Key: the pair.
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
public final class FollowEncounters extends EventTimeOperator<Pair, Sighting, Meeting, Encounter> {
    private static final long serialVersionUID = 1L;

    private final Follower follower;

    private transient Counter violations;

    FollowEncounters(CollisionRules rules) {
        super(new PendingSightingsFormat());
        follower = new Follower(rules.exact());
    }

    @Override
    protected Comparator<Sighting> sequence() {
        return Sighting.SEQUENCE;
    }

    @Override
    public void open() throws Exception {
        super.open();
        violations = getMetricGroup().counter("violations");
    }

    @Override
    protected Meeting apply(Pair pair, Meeting before, List<Sighting> due, long until, Collector<Encounter> out) {
        Follower.Followed followed = follower.follow(before, due, out::collect);
        violations.inc(followed.violations());
        return followed.meeting();
    }
}
