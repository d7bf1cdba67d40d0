package io.furrow.analytics.collision.motion;

import java.util.Comparator;

import io.furrow.analytics.eventtime.HasEventTime;
import io.furrow.analytics.position.PositionFix;

/**
 * That two devices' segments come within the threshold, as one cube saw it.
 *
 * @param first the device with the lesser id, in the order of {@link PositionFix#NAMING}
 * @param second the other device
 * @param time when this is known: the newest of the reports that it follows from, epoch milliseconds
 * @param apart meters between the newest positions
 * @param distance meters when they are closest
 * @param closest when that is; of the original time, since it has a fraction
 * @param from the first instant that both segments cover; of segments ahead the same as {@code time}
 * @param until the last
 * @param contactFrom since when they are within the threshold, rounded down
 * @param contactUntil until when, rounded down: less than {@code until} where they part before, be it by less than a millisecond
 * @param reportedClose whether the newest positions were close too, at one of both ends
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

    /** One text per pair; the length before it keeps two pairs from ever sharing one. */
    String pair() {
        return first.key().length() + ":" + first.key() + second.key();
    }
}
