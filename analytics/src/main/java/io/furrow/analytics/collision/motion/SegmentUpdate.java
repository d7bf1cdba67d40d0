package io.furrow.analytics.collision.motion;

import java.util.Comparator;

import io.furrow.analytics.eventtime.HasEventTime;

/**
 * A change of a device's segments in one cube.
 *
 * @param cube id of the cube
 * @param time of the device's newest position, epoch milliseconds
 * @param segment the segment; of {@link Change#PREDICTION_ENDED} the one that no longer holds
 */
public record SegmentUpdate(long cube, long time, Change change, MotionSegment segment) implements HasEventTime {
    /** The kind of change. */
    public enum Change {
        OBSERVED,
        PREDICTED,
        PREDICTION_ENDED
    }

    static final Comparator<SegmentUpdate> SEQUENCE = Comparator.comparingLong(SegmentUpdate::time)
            .thenComparing(update -> update.segment().fix().key())
            .thenComparing(SegmentUpdate::change);
}
