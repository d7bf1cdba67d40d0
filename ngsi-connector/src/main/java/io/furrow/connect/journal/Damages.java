package io.furrow.connect.journal;

import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Set;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** What could not be read since the journal was opened; each damage is logged and counted once, however often it is met. */
final class Damages {
    private static final Logger LOG = LoggerFactory.getLogger(Damages.class);
    private static final int REMEMBERED = 10_000;

    /** A corruption may be met again from a later position of the same hole. */
    private record Place(long segment, long to, Damage.Kind kind) {}

    private final String journal;
    private final Set<Place> places = new HashSet<>();
    private final List<Damage> all = new ArrayList<>();
    private long records;
    private long bytes;

    Damages(String journal) {
        this.journal = journal;
    }

    synchronized void note(Damage damage) {
        if (places.size() >= REMEMBERED || !places.add(new Place(damage.segment(), damage.to(), damage.kind()))) {
            return;
        }
        all.add(damage);
        records += Math.max(0, damage.records());
        bytes += damage.bytes();
        if (damage.kind() == Damage.Kind.TORN_TAIL) {
            LOG.warn(
                    "journal {}: {} bytes of an append that had not ended were dropped: {}",
                    journal,
                    damage.bytes(),
                    damage);
        } else {
            LOG.error("journal {}: damaged on disk, went on behind it: {}", journal, damage);
        }
    }

    synchronized List<Damage> all() {
        return List.copyOf(all);
    }

    synchronized long records() {
        return records;
    }

    synchronized long bytes() {
        return bytes;
    }
}
