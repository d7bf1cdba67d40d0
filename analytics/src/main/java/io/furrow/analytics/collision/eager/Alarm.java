package io.furrow.analytics.collision.eager;

import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;

import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Phase;

/**
 * What has been notified of a pair before the watermark decided.
 *
 * @param firstVersion of the newest glimpse
 * @param secondVersion of the newest glimpse
 * @param close whether the pair was close in it
 * @param open provisional records that are neither confirmed nor withdrawn, in the order of emission
 */
public record Alarm(long firstVersion, long secondVersion, boolean close, List<Encounter> open) {
    static final Alarm NONE = new Alarm(Long.MIN_VALUE, Long.MIN_VALUE, false, List.of());

    /**
     * After a glimpse. One that knows less of either device is skipped: the cell will emit again when it knows. Of two
     * with the same versions the close one counts: the other comes from a cell that the pair has left.
     */
    Alarm after(ProvisionalProximity glimpse, Consumer<Encounter> out) {
        boolean same = glimpse.firstVersion() == firstVersion && glimpse.secondVersion() == secondVersion;
        if (glimpse.firstVersion() < firstVersion || glimpse.secondVersion() < secondVersion) {
            return this;
        }
        List<Encounter> now = open;
        if (glimpse.close() && !close && !same) {
            Encounter provisional = Encounter.provisional(glimpse.first(), glimpse.second());
            if (open.stream().noneMatch(each -> each.id().equals(provisional.id()))) {
                now = new ArrayList<>(open);
                now.add(provisional);
                out.accept(provisional);
            }
        }
        return new Alarm(glimpse.firstVersion(), glimpse.secondVersion(), glimpse.close() || same && close, now);
    }

    /** After an exact record. A start confirms the first provisional record that begins no earlier than its encounter. */
    Alarm after(Encounter exact, Consumer<Encounter> out) {
        if (exact.phase() == Phase.STARTED) {
            for (Encounter provisional : open) {
                if (provisional.time() >= exact.startTime()) {
                    List<Encounter> now = new ArrayList<>(open);
                    now.remove(provisional);
                    out.accept(exact.confirming(provisional));
                    return new Alarm(firstVersion, secondVersion, close, now);
                }
            }
        }
        out.accept(exact);
        return this;
    }

    /** After the decision on all up to an instant: what no start has confirmed is withdrawn. */
    Alarm decided(long until, Consumer<Encounter> out) {
        List<Encounter> now = new ArrayList<>(open);
        for (Encounter provisional : open) {
            if (provisional.time() <= until) {
                now.remove(provisional);
                out.accept(provisional.withdrawn());
            }
        }
        return new Alarm(firstVersion, secondVersion, close, now);
    }

    /**
     * Whether the pair is apart, all is decided, and no message of these versions can be under way any more. A pair that is close
     * is seen with each report of its devices: one that is not for a time-to-live was emitted by rules that no longer count.
     */
    boolean isOver(long watermark, long timeToLive) {
        return open.isEmpty() && lastVersion() + (close ? timeToLive : 0) <= watermark;
    }

    /** The first watermark that decides something. */
    long nextDecision(long dwell, long timeToLive) {
        if (open.isEmpty()) {
            return lastVersion() + (close ? timeToLive : 0);
        }
        return open.get(0).time() + dwell; // emitted in the order of time
    }

    private long lastVersion() {
        return Math.max(firstVersion, secondVersion);
    }
}
