package io.furrow.analytics.collision.matching;

import java.util.Comparator;
import java.util.List;
import java.util.PriorityQueue;

import io.furrow.analytics.position.PositionFix;

/**
 * Selects a limited number of nearest devices. Distance counts in quarters of the threshold, so that the noise of receivers
 * does not change the choice all the time; within a quarter, previously chosen devices come first, then the nearer, then by
 * name.
 */
final class Nearest {
    private static final Comparator<Candidate> ORDER = Comparator.comparingInt(Candidate::quarter)
            .thenComparing(Candidate::known, Comparator.reverseOrder())
            .thenComparingDouble(Candidate::nearness)
            .thenComparing(Candidate::fix, PositionFix.NAMING);

    private final int room;
    /** The last in order first. */
    private final PriorityQueue<Candidate> chosen = new PriorityQueue<>(ORDER.reversed());

    private record Candidate(PositionFix fix, int quarter, boolean known, double nearness) {}

    Nearest(int room) {
        this.room = room;
    }

    /**
     * @param nearness the squared distance divided by the squared threshold
     * @param known whether it was chosen before
     */
    void offer(PositionFix fix, double nearness, boolean known) {
        int quarter = nearness <= 1 / 16.0 ? 0 : nearness <= 1 / 4.0 ? 1 : nearness <= 9 / 16.0 ? 2 : 3;
        if (chosen.size() < room) {
            chosen.add(new Candidate(fix, quarter, known, nearness));
            return;
        }
        Candidate last = chosen.peek();
        if (quarter > last.quarter || quarter == last.quarter && last.known && !known) {
            return; // most are, in a crowd
        }
        Candidate candidate = new Candidate(fix, quarter, known, nearness);
        if (ORDER.compare(candidate, last) < 0) {
            chosen.remove();
            chosen.add(candidate);
        }
    }

    List<String> identities() {
        return chosen.stream().map(candidate -> candidate.fix.identity()).toList();
    }
}
