package io.furrow.connect.journal;

import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Set;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** Collects the corruptions found since the journal was opened; each is logged and counted once. */
final class Corruptions {
    private static final Logger LOG = LoggerFactory.getLogger(Corruptions.class);
    private static final int REMEMBERED = 10_000;

    /** Readers may meet a corruption again from a later position of the same hole. */
    private record Place(long segment, long to, Corruption.Kind kind) {}

    private final String journal;
    private final Set<Place> places = new HashSet<>();
    private final List<Corruption> all = new ArrayList<>();
    private long records;
    private long bytes;

    Corruptions(String journal) {
        this.journal = journal;
    }

    synchronized void note(Corruption damage) {
        if (places.size() >= REMEMBERED || !places.add(new Place(damage.segment(), damage.to(), damage.kind()))) {
            return;
        }
        all.add(damage);
        records += Math.max(0, damage.records());
        bytes += damage.bytes();
        if (damage.kind() == Corruption.Kind.TORN_TAIL) {
            LOG.warn("journal {}: dropped {} bytes of an incomplete append: {}", journal, damage.bytes(), damage);
        } else {
            LOG.error("journal {}: skipped a corrupt part on disk: {}", journal, damage);
        }
    }

    synchronized List<Corruption> all() {
        return List.copyOf(all);
    }

    synchronized long records() {
        return records;
    }

    synchronized long bytes() {
        return bytes;
    }
}
