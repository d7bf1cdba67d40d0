package io.furrow.analytics.collision.motion;

import java.util.ArrayList;
import java.util.List;

/**
 * A device whose segments touch a cube.
 *
 * @param ahead the segment from its newest position on; null if unknown or outside the cube
 * @param behind the segments up to its newest position, the oldest first
 */
public record MovingDevice(MotionSegment ahead, List<MotionSegment> behind) {
    static final MovingDevice UNKNOWN = new MovingDevice(null, List.of());

    MovingDevice with(SegmentUpdate update) {
        return switch (update.change()) {
            case PREDICTED -> new MovingDevice(update.segment(), behind);
            case PREDICTION_ENDED -> new MovingDevice(null, behind);
            case OBSERVED -> {
                List<MotionSegment> all = new ArrayList<>(behind);
                all.add(update.segment());
                yield new MovingDevice(ahead, all);
            }
        };
    }

    /** Removes segments that can meet nothing reported after the instant. */
    MovingDevice without(long until, long timeToLive) {
        MotionSegment counting = ahead != null && aheadEnd(timeToLive) > until ? ahead : null;
        List<MotionSegment> recent = behind.stream()
                .filter(segment -> segment.until() + timeToLive > until)
                .toList();
        return counting == ahead && recent.size() == behind.size() ? this : new MovingDevice(counting, recent);
    }

    boolean isGone() {
        return ahead == null && behind.isEmpty();
    }

    /** The first instant at which one of its segments expires. */
    long nextEnd(long timeToLive) {
        long end = ahead == null ? Long.MAX_VALUE : aheadEnd(timeToLive);
        return behind.isEmpty() ? end : Math.min(end, behind.get(0).until() + timeToLive);
    }

    private long aheadEnd(long timeToLive) {
        return Math.min(ahead.until() + 1, ahead.from() + timeToLive);
    }
}
