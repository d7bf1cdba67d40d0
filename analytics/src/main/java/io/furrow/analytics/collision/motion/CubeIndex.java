package io.furrow.analytics.collision.motion;

import java.util.HashMap;
import java.util.List;
import java.util.Map;

/**
 * The devices whose segments touch a cube.
 *
 * @param movers by {@link io.furrow.analytics.position.PositionFix#key}; changed in place
 */
public record CubeIndex(Map<String, MovingDevice> movers) {
    static CubeIndex empty() {
        return new CubeIndex(new HashMap<>());
    }

    boolean isEmpty() {
        return movers.isEmpty();
    }

    /**
     * Applies updates instant by instant and emits the approaches of new segments.
     *
     * @param updates in the order of {@link SegmentUpdate#SEQUENCE}
     */
    void apply(List<SegmentUpdate> updates, ApproachDetector watch) {
        int from = 0;
        while (from < updates.size()) {
            int to = from + 1;
            while (to < updates.size()
                    && updates.get(to).time() == updates.get(from).time()) {
                to++;
            }
            applyAtOnce(updates.subList(from, to), watch);
            from = to;
        }
    }

    private void applyAtOnce(List<SegmentUpdate> updates, ApproachDetector watch) {
        for (SegmentUpdate update : updates) {
            movers.compute(
                    update.segment().fix().key(),
                    (device, known) -> (known == null ? MovingDevice.UNKNOWN : known).with(update));
        }
        for (SegmentUpdate update : updates) {
            String device = update.segment().fix().key();
            movers.forEach((other, mover) -> {
                if (!other.equals(device)) {
                    compare(update, mover, device.compareTo(other) < 0, watch);
                }
            });
        }
    }

    /** Two segments that are new at the same instant are compared once, with the update of the lesser device. */
    private static void compare(SegmentUpdate update, MovingDevice other, boolean lesser, ApproachDetector watch) {
        long now = update.time();
        if (update.change() == SegmentUpdate.Change.PREDICTED) {
            if (other.ahead() != null && (lesser || other.ahead().fix().time() < now)) {
                watch.ahead(update.segment(), other.ahead(), now);
            }
        } else if (update.change() == SegmentUpdate.Change.OBSERVED) {
            List<MotionSegment> behind = other.behind();
            for (int i = behind.size() - 1;
                    i >= 0 && behind.get(i).until() > update.segment().from();
                    i--) {
                if (lesser || behind.get(i).until() < now) {
                    watch.behind(update.segment(), behind.get(i));
                }
            }
        }
    }

    /** Removes segments that can meet nothing after the instant. */
    void forget(long until, long timeToLive) {
        movers.replaceAll((device, mover) -> mover.without(until, timeToLive));
        movers.values().removeIf(MovingDevice::isGone);
    }

    /** The first instant at which a segment expires. */
    long nextEnd(long timeToLive) {
        long end = Long.MAX_VALUE;
        for (MovingDevice mover : movers.values()) {
            end = Math.min(end, mover.nextEnd(timeToLive));
        }
        return end;
    }
}
