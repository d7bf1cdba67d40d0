package io.furrow.analytics.collision.grid;

import java.io.Serializable;
import java.util.List;
import java.util.function.Consumer;

import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.collision.rules.ExclusionZones;
import io.furrow.analytics.position.PositionFix;

/** Moves a device through the grid: turns its positions, and their expiry, into updates of cells. */
public final class Tracker implements Serializable {
    private static final long serialVersionUID = 1L;
    private static final long[] NO_CELLS = {};

    private final Grid grid;
    private final ExclusionZones zones;
    private final long timeToLive;

    public Tracker(CollisionRules rules) {
        zones = rules.positions().zones();
        grid = new Grid(rules);
        timeToLive = rules.timeToLive().toMillis();
    }

    /**
     * The track after all positions of one device up to an instant; null for none, as before the first.
     *
     * @param due in the order of {@link PositionFix#SEQUENCE}, none later than {@code until}
     * @param out receives the updates of cells in order of time
     */
    public Track advance(Track track, List<PositionFix> due, long until, Consumer<CellUpdate> out) {
        Track now = track;
        for (int i = 0; i < due.size(); i++) {
            PositionFix fix = due.get(i);
            boolean outdone = i + 1 < due.size() && due.get(i + 1).time() == fix.time();
            if (!outdone) {
                now = move(expire(now, fix.time() - 1, out), fix, out);
            }
        }
        return expire(now, until, out);
    }

    /** The first instant at which the track's position is no longer valid. */
    long expiry(Track track) {
        return track.last().time() + timeToLive;
    }

    private Track expire(Track track, long until, Consumer<CellUpdate> out) {
        if (track == null || expiry(track) > until) {
            return track;
        }
        leave(track, expiry(track), out);
        return null;
    }

    private static void leave(Track track, long time, Consumer<CellUpdate> out) {
        for (long cell : track.cells()) {
            out.accept(new CellUpdate(cell, time, CellPresence.GONE, track.last()));
        }
    }

    /**
     * Moves the track of a device to a position.
     *
     * @param track null before the first
     */
    public Track move(Track track, PositionFix fix, Consumer<CellUpdate> out) {
        boolean excluded = zones.cover(fix.latitude(), fix.longitude());
        long[] cells = excluded ? NO_CELLS : grid.cells(fix.latitude(), fix.longitude());
        for (long left : track == null ? NO_CELLS : track.cells()) {
            if (!contains(cells, left)) {
                out.accept(new CellUpdate(left, fix.time(), CellPresence.GONE, track.last()));
            }
        }
        for (int i = 0; i < cells.length; i++) {
            CellPresence cellPresence = i == 0 ? CellPresence.RESIDENT : CellPresence.HALO;
            out.accept(new CellUpdate(cells[i], fix.time(), cellPresence, fix));
        }
        return new Track(fix, cells);
    }

    private static boolean contains(long[] cells, long cell) {
        for (long each : cells) {
            if (each == cell) {
                return true;
            }
        }
        return false;
    }
}
