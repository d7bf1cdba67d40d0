package io.furrow.analytics.collision.motion;

import java.util.HashMap;
import java.util.List;
import java.util.Map;

/**
 * The devices whose legs touch a cube.
 *
 * @param movers by {@link io.furrow.analytics.position.PositionFix#key}; changed in place
 */
public record Neighbourhood(Map<String, MovingDevice> movers) {
    static Neighbourhood empty() {
        return new Neighbourhood(new HashMap<>());
    }

    boolean isEmpty() {
        return movers.isEmpty();
    }

    /**
     * Applies updates instant by instant and emits what the new legs come close to.
     *
     * @param updates in the order of {@link LegUpdate#SEQUENCE}
     */
    void apply(List<LegUpdate> updates, ApproachDetector watch) {
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

    private void applyAtOnce(List<LegUpdate> updates, ApproachDetector watch) {
        for (LegUpdate update : updates) {
            movers.compute(
                    update.leg().fix().key(),
                    (device, known) -> (known == null ? MovingDevice.UNKNOWN : known).with(update));
        }
        for (LegUpdate update : updates) {
            String device = update.leg().fix().key();
            movers.forEach((other, mover) -> {
                if (!other.equals(device)) {
                    compare(update, mover, device.compareTo(other) < 0, watch);
                }
            });
        }
    }

    /** Two legs that are new at the same instant are compared once, when it is the turn of the lesser device. */
    private static void compare(LegUpdate update, MovingDevice other, boolean lesser, ApproachDetector watch) {
        long now = update.time();
        if (update.change() == LegUpdate.Change.LEG_AHEAD) {
            if (other.ahead() != null && (lesser || other.ahead().fix().time() < now)) {
                watch.ahead(update.leg(), other.ahead(), now);
            }
        } else if (update.change() == LegUpdate.Change.LEG_BEHIND) {
            List<Leg> behind = other.behind();
            for (int i = behind.size() - 1;
                    i >= 0 && behind.get(i).until() > update.leg().from();
                    i--) {
                if (lesser || behind.get(i).until() < now) {
                    watch.behind(update.leg(), behind.get(i));
                }
            }
        }
    }

    /** Forgets what can meet nothing that comes after the instant. */
    void forget(long until, long timeToLive) {
        movers.replaceAll((device, mover) -> mover.without(until, timeToLive));
        movers.values().removeIf(MovingDevice::isGone);
    }

    /** The first instant at which something is to be forgotten. */
    long nextEnd(long timeToLive) {
        long end = Long.MAX_VALUE;
        for (MovingDevice mover : movers.values()) {
            end = Math.min(end, mover.nextEnd(timeToLive));
        }
        return end;
    }
}
