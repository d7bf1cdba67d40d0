package io.furrow.analytics.collision.motion;

import java.util.List;
import java.util.function.Consumer;

/**
 * A prediction that lasts.
 *
 * @param startTime when it was first emitted, epoch milliseconds
 * @param held when it last held
 * @param reported event time of the newest record about it
 */
public record OngoingPrediction(long startTime, long held, long reported) {

    /** When it is over unless it holds again before. */
    long lapse(MotionRules rules) {
        return held + rules.horizon().toMillis();
    }

    /**
     * What a pair's predictions come to.
     *
     * @param before null if none lasts
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
