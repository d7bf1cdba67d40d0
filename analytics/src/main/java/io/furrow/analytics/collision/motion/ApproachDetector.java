package io.furrow.analytics.collision.motion;

import java.util.function.Consumer;

import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.record.Epochs;

/**
 * Detects in one cube whether two segments come within the threshold.
 *
 * @param cube only approaches whose closest point is in it are emitted, so that each is emitted once
 * @param predictions receives candidates about segments ahead
 * @param contacts receives candidates about segments behind
 */
record ApproachDetector(
        MotionRules rules,
        Cubes cubes,
        long cube,
        Consumer<ApproachCandidate> predictions,
        Consumer<ApproachCandidate> contacts) {

    /** Compares two segments ahead of the newest positions; {@code now} is the instant at which one of them was reported. */
    void ahead(MotionSegment one, MotionSegment other, long now) {
        long oldest = Math.min(one.from(), other.from());
        CartesianPoint start = one.start();
        if (now - oldest < rules.timeToLive()
                && mayMeet(one, other)
                && start.distance(other.start()) > threshold(one, other)) {
            tell(one, other, new Interval(now, Math.min(one.until(), other.until()), now), false, predictions);
        }
    }

    /** Compares two segments that end at a position each. */
    void behind(MotionSegment one, MotionSegment other) {
        long from = Math.max(one.from(), other.from());
        long until = Math.min(one.until(), other.until());
        if (from < until && mayMeet(one, other)) {
            double reported = Math.min(
                    one.start().distance(other.start()), held(one, until).distance(held(other, until)));
            long now = Math.max(one.until(), other.until());
            tell(one, other, new Interval(from, until, now), reported <= threshold(one, other), contacts);
        }
    }

    /** The interval in which two segments are compared, and the time from which it is known. */
    private record Interval(long from, long until, long known) {
        /** An interval ahead begins now, one behind began before. */
        boolean isAhead() {
            return known == from;
        }
    }

    /** The newest position reported by then, which encounters are based on. */
    private static CartesianPoint held(MotionSegment segment, long time) {
        return segment.until() == time ? segment.at(Epochs.original(time)) : segment.start();
    }

    private double threshold(MotionSegment one, MotionSegment other) {
        return rules.common().thresholds().between(one.fix().type(), other.fix().type());
    }

    private static boolean mayMeet(MotionSegment one, MotionSegment other) {
        return one.fix().topic().equals(other.fix().topic()) && !one.fix().sharesAggregateWith(other.fix());
    }

    private void tell(
            MotionSegment one,
            MotionSegment other,
            Interval interval,
            boolean reportedClose,
            Consumer<ApproachCandidate> out) {
        boolean inOrder = PositionFix.NAMING.compare(one.fix(), other.fix()) < 0;
        MotionSegment first = inOrder ? one : other;
        MotionSegment second = inOrder ? other : one;
        long epoch = Epochs.begin(interval.from);
        ClosestApproach.within(threshold(first, second), first, second, interval.from - epoch, interval.until - epoch)
                .filter(approach -> cubes.cube(first.fix().topic(), first.at(approach.time())) == cube)
                .ifPresent(approach -> out.accept(new ApproachCandidate(
                        interval.isAhead() ? first.fix() : first.fixAt(approach.time()),
                        interval.isAhead() ? second.fix() : second.fixAt(approach.time()),
                        interval.known,
                        first.start().distance(second.start()),
                        approach.distance(),
                        approach.time(),
                        interval.from,
                        interval.until,
                        epoch + (long) Math.floor(approach.contactFrom()),
                        epoch + (long) Math.floor(approach.contactUntil()),
                        reportedClose)));
    }
}
