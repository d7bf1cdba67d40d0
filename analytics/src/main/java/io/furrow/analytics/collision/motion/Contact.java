package io.furrow.analytics.collision.motion;

import java.util.List;
import java.util.function.Consumer;

/**
 * Segments of a pair that are within the threshold and may remain so.
 *
 * @param nearest the candidate with the closest point
 * @param from start of the contact, epoch milliseconds
 * @param until end of the segments received so far
 * @param reportedClose whether reports show the devices close as well: then it is an encounter, and not emitted here
 */
public record Contact(ApproachCandidate nearest, long from, long until, boolean reportedClose) {

    private static Contact of(ApproachCandidate candidate) {
        return new Contact(candidate, candidate.contactFrom(), candidate.until(), candidate.reportedClose());
    }

    /**
     * Joins a pair's candidates into contacts; returns the open one, or null.
     *
     * @param before null if no contact was open
     * @param candidates in the order of {@link ApproachCandidate#SEQUENCE}
     */
    static Contact join(Contact before, List<ApproachCandidate> candidates, Consumer<Approach> out) {
        Contact open = before;
        for (ApproachCandidate candidate : candidates) {
            if (open != null && open.isContinuedBy(candidate)) {
                open = open.joinedBy(candidate);
            } else {
                close(open, out);
                open = of(candidate);
            }
            if (candidate.contactUntil() < candidate.until()) {
                close(open, out);
                open = null;
            }
        }
        return open;
    }

    /** Emits the contact if no report shows it. */
    static void close(Contact contact, Consumer<Approach> out) {
        if (contact != null && !contact.reportedClose) {
            out.accept(Approach.crossed(contact));
        }
    }

    private boolean isContinuedBy(ApproachCandidate candidate) {
        return until == candidate.from() && candidate.contactFrom() <= candidate.from();
    }

    private Contact joinedBy(ApproachCandidate candidate) {
        ApproachCandidate closer = candidate.distance() < nearest.distance() ? candidate : nearest;
        return new Contact(closer, from, candidate.until(), reportedClose || candidate.reportedClose());
    }
}
