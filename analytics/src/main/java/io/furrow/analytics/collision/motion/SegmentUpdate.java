package io.furrow.analytics.collision.motion;

import java.util.Comparator;

import io.furrow.analytics.eventtime.HasEventTime;

/**
 * What becomes of a device's segments in one cube.
 *
 * @param cube id of the cube
 * @param time when this is known, epoch milliseconds: that of the device's newest position
 * @param segment the segment; of {@link Change#PREDICTION_ENDED} the one that holds no more
 */
public record SegmentUpdate(long cube, long time, Change change, MotionSegment segment) implements HasEventTime {
    /** What is new. */
    public enum Change {
        OBSERVED,
        PREDICTED,
        PREDICTION_ENDED
    }

    static final Comparator<SegmentUpdate> SEQUENCE = Comparator.comparingLong(SegmentUpdate::time)
            .thenComparing(update -> update.segment().fix().key())
            .thenComparing(SegmentUpdate::change);
}
