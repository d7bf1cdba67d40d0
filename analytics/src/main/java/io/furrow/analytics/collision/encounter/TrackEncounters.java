package io.furrow.analytics.collision.encounter;

import java.util.Comparator;
import java.util.List;

import org.apache.flink.metrics.Counter;
import org.apache.flink.runtime.state.StateInitializationContext;
import org.apache.flink.runtime.state.StateSnapshotContext;
import org.apache.flink.util.Collector;

import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.collision.rules.RestoredRules;
import io.furrow.analytics.eventtime.EventTimeOperator;

/**
 * Emits the life cycle of each encounter: started, ongoing, ended. Key: the pair.
 *
 * <p><b>State</b>: observations that wait for the watermark; start, closest distance and newest report of an encounter.
 *
 * <p><b>Cleared</b>: when the encounter has ended and no observation waits. When restored with changed rules, each encounter ends at
 * its newest position.
 *
 * <p><b>Late</b>: impossible; the previous stage acts before it forwards a watermark.
 *
 * <p><b>Emits</b>: records of encounters, a pair's in order of time. {@code violations} counts instants at which cells contradict
 * each other: always 0 unless the code is wrong.
 */
public final class TrackEncounters extends EventTimeOperator<Pair, PairObservation, OpenEncounter, Encounter> {
    private static final long serialVersionUID = 1L;

    private final EncounterTracker tracker;
    private final CollisionRules rules;

    private transient RestoredRules restored;
    private transient Counter violations;

    public TrackEncounters(CollisionRules rules) {
        super(new PendingObservationsSerializer());
        this.rules = rules.exact();
        tracker = new EncounterTracker(this.rules);
    }

    @Override
    protected Comparator<PairObservation> sequence() {
        return PairObservation.SEQUENCE;
    }

    @Override
    public void initializeState(StateInitializationContext context) throws Exception {
        super.initializeState(context);
        restored = RestoredRules.of(context.getOperatorStateStore(), rules);
    }

    @Override
    public void snapshotState(StateSnapshotContext context) throws Exception {
        super.snapshotState(context);
        restored.snapshot();
    }

    @Override
    public void open() throws Exception {
        super.open();
        violations = getMetricGroup().counter("violations");
        if (restored.changed()) {
            forget(true, (encounter, out) -> out.collect(EncounterTracker.cutOff(encounter)));
        }
    }

    @Override
    protected OpenEncounter apply(
            Pair pair, OpenEncounter before, List<PairObservation> due, long until, Collector<Encounter> out) {
        EncounterTracker.Followed followed = tracker.follow(before, due, out::collect);
        violations.inc(followed.violations());
        return followed.encounter();
    }
}
