package io.furrow.analytics.collision.motion;

import java.util.Comparator;

import io.furrow.analytics.eventtime.HasEventTime;
import io.furrow.analytics.position.PositionFix;

/**
 * The approach of two devices' segments within the threshold, as found in one cube.
 *
 * @param first the device with the lesser id, in the order of {@link PositionFix#NAMING}
 * @param second the other device
 * @param time the newest of the reports that it follows from, epoch milliseconds
 * @param apart meters between the newest positions
 * @param distance meters at the closest point
 * @param closest time of the closest point; original time, since it has a fraction
 * @param from the first instant that both segments cover; of segments ahead the same as {@code time}
 * @param until the last
 * @param contactFrom start of the contact within the threshold, rounded down
 * @param contactUntil its end, rounded down: less than {@code until} if they part before, be it by less than a millisecond
 * @param reportedClose whether the newest positions were close too, at either end
 */
public record ApproachCandidate(
        PositionFix first,
        PositionFix second,
        long time,
        double apart,
        double distance,
        double closest,
        long from,
        long until,
        long contactFrom,
        long contactUntil,
        boolean reportedClose)
        implements HasEventTime {
    static final Comparator<ApproachCandidate> SEQUENCE =
            Comparator.comparingLong(ApproachCandidate::time).thenComparingLong(ApproachCandidate::from);

    /** A unique key of the pair; the length in front makes it unambiguous. */
    String pair() {
        return first.key().length() + ":" + first.key() + second.key();
    }
}
