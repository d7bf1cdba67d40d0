package io.furrow.analytics.collision.motion;

import java.util.List;
import java.util.function.Consumer;

/**
 * An ongoing prediction.
 *
 * @param startTime first emitted, epoch milliseconds
 * @param held last instant at which it held
 * @param reported event time of its newest record
 */
public record OngoingPrediction(long startTime, long held, long reported) {

    /** When the prediction ends unless it holds again before. */
    long lapse(MotionRules rules) {
        return held + rules.horizon().toMillis();
    }

    /**
     * Applies a pair's candidates and returns the ongoing prediction, if any.
     *
     * @param before null if none is ongoing
     * @param candidates in the order of {@link ApproachCandidate#SEQUENCE}
     */
    static OngoingPrediction follow(
            OngoingPrediction before, List<ApproachCandidate> candidates, MotionRules rules, Consumer<Approach> out) {
        OngoingPrediction known = before;
        for (ApproachCandidate candidate : candidates) {
            long now = candidate.time();
            boolean goesOn = known != null && now < known.lapse(rules);
            boolean report = !goesOn
                    || now - known.reported >= rules.common().ongoingEvery().toMillis();
            known = new OngoingPrediction(goesOn ? known.startTime : now, now, report ? now : known.reported);
            if (report) {
                out.accept(Approach.predicted(candidate, known.startTime));
            }
        }
        return known;
    }
}
