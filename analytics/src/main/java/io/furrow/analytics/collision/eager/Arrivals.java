package io.furrow.analytics.collision.eager;

import java.util.ArrayList;
import java.util.Collection;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;

import org.apache.flink.api.common.typeinfo.TypeInfo;

import io.furrow.analytics.collision.encounter.PairObservation;
import io.furrow.analytics.collision.grid.Cell;
import io.furrow.analytics.collision.grid.CellUpdate;
import io.furrow.analytics.collision.grid.Member;
import io.furrow.analytics.collision.grid.Presence;
import io.furrow.analytics.collision.matching.Matching;
import io.furrow.analytics.collision.matching.Shortlist;
import io.furrow.analytics.position.Device;
import io.furrow.analytics.position.PositionFix;

/**
 * What has arrived of the devices of one grid cell; changed in place. Who has left stays as a tombstone until the watermark
 * has passed it, so that no message that comes behind brings it back.
 */
@TypeInfo(ArrivalsSerializer.class)
public final class Arrivals {
    private final Map<Device, Arrival> newest = new HashMap<>();
    private final Cell cell = Cell.empty();

    public Collection<Arrival> all() {
        return newest.values();
    }

    boolean isEmpty() {
        return newest.isEmpty();
    }

    /** Only before the first is applied. */
    public void put(Arrival arrival, Shortlist shortlist) {
        newest.put(arrival.fix().device(), arrival);
        if (arrival.presence() != Presence.GONE) {
            Member member = Member.of(arrival.fix(), arrival.presence() == Presence.RESIDENT);
            member.shortlist(shortlist);
            cell.put(member);
        }
    }

    /** Of the devices in crowds. */
    public Map<Device, Shortlist> shortlists() {
        if (!cell.isCrowded()) {
            return Map.of();
        }
        Map<Device, Shortlist> shortlists = new HashMap<>();
        for (Member member : cell.members()) {
            if (member.shortlist() != null) {
                shortlists.put(member.fix().device(), member.shortlist());
            }
        }
        return shortlists;
    }

    /** Takes the arrival if it is newer than what is known of its device, and returns which pairs changed. */
    void apply(Arrival arrival, Matching matching, Consumer<ProvisionalProximity> out) {
        Arrival known = newest.get(arrival.fix().device());
        if (known != null && known.version() >= arrival.version()) {
            return;
        }
        newest.put(arrival.fix().device(), arrival);
        CellUpdate update = new CellUpdate(arrival.cell(), arrival.version(), arrival.presence(), arrival.fix());
        cell.apply(List.of(update), matching, seen -> out.accept(glimpse(seen)));
    }

    /** Lets the devices go whose time-to-live the watermark has passed, and forgets tombstones that it has passed. */
    void pass(long watermark, long timeToLive, Matching matching, Consumer<ProvisionalProximity> out) {
        for (Arrival each : new ArrayList<>(newest.values())) {
            long end = each.fix().time() + timeToLive;
            if (each.presence() != Presence.GONE && end <= watermark) {
                long version = Math.max(end, each.version() + 1);
                apply(new Arrival(each.cell(), version, Presence.GONE, each.fix()), matching, out);
            }
        }
        newest.values().removeIf(each -> each.presence() == Presence.GONE && each.version() <= watermark);
    }

    /** The first watermark that changes something. */
    long nextPass(long timeToLive) {
        long next = Long.MAX_VALUE;
        for (Arrival each : newest.values()) {
            next = Math.min(next, passes(each, timeToLive));
        }
        return next;
    }

    static long passes(Arrival arrival, long timeToLive) {
        return arrival.presence() == Presence.GONE
                ? arrival.version()
                : arrival.fix().time() + timeToLive;
    }

    private ProvisionalProximity glimpse(PairObservation seen) {
        return new ProvisionalProximity(
                seen.first(), seen.second(), version(seen.first()), version(seen.second()), seen.change() >= 0);
    }

    private long version(PositionFix fix) {
        return newest.get(fix.device()).version();
    }
}
