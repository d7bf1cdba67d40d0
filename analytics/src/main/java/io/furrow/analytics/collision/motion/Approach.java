package io.furrow.analytics.collision.motion;

import io.furrow.analytics.collision.encounter.PairId;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.record.Epochs;

/**
 * A prediction that two devices will come within the threshold, or a crossing: they did so between their reports.
 * Complete in itself.
 *
 * @param phase {@link Phase#PREDICTED} or {@link Phase#CROSSED}
 * @param first the device with the lesser id; predicted: at its newest position; crossed: at the closest point
 * @param second the other device
 * @param distance meters between these two positions
 * @param dcpa meters at the closest point of approach
 * @param tcpa seconds from {@code time} to the closest point of approach; 0 if that is in the past
 * @param startTime predicted: first emitted; crossed: start of the contact; epoch milliseconds
 * @param time predicted: the newer of both positions; crossed: the closest point; epoch milliseconds
 */
public record Approach(
        Phase phase,
        PositionFix first,
        PositionFix second,
        double distance,
        double dcpa,
        double tcpa,
        long startTime,
        long time) {

    static Approach predicted(ApproachCandidate candidate, long startTime) {
        return new Approach(
                Phase.PREDICTED,
                candidate.first(),
                candidate.second(),
                candidate.apart(),
                candidate.distance(),
                (candidate.closest() - Epochs.original(candidate.time())) / 1000,
                startTime,
                candidate.time());
    }

    static Approach crossed(Contact contact) {
        ApproachCandidate nearest = contact.nearest();
        return new Approach(
                Phase.CROSSED,
                nearest.first(),
                nearest.second(),
                nearest.distance(),
                nearest.distance(),
                0,
                contact.from(),
                Epochs.begin(nearest.time()) + (long) nearest.closest());
    }

    /** Pair, start and phase: distinct from the ids of encounters, the same in a second pass. */
    public String id() {
        return pairId() + "@" + Epochs.text(startTime) + "-" + phase.code();
    }

    /** The pair's id: 32 hexadecimal digits. */
    public String pairId() {
        return PairId.of(first.identity(), second.identity());
    }
}
