package io.furrow.analytics.collision.motion;

import java.util.List;
import java.util.function.Consumer;

/**
 * Legs of a pair that are within the threshold and may continue to be so.
 *
 * @param nearest what was found where they were closest
 * @param from when it began, epoch milliseconds
 * @param until up to when the legs are known
 * @param reportedClose whether the reports saw the devices close as well: then it is an encounter, and not emitted here
 */
public record Contact(Finding nearest, long from, long until, boolean reportedClose) {

    private static Contact of(Finding finding) {
        return new Contact(finding, finding.contactFrom(), finding.until(), finding.reportedClose());
    }

    /**
     * What the legs of a pair come to; null if no contact is open at the end.
     *
     * @param before null if none was
     * @param findings in the order of {@link Finding#SEQUENCE}
     */
    static Contact join(Contact before, List<Finding> findings, Consumer<Approach> out) {
        Contact open = before;
        for (Finding finding : findings) {
            if (open != null && open.isContinuedBy(finding)) {
                open = open.joinedBy(finding);
            } else {
                close(open, out);
                open = of(finding);
            }
            if (finding.contactUntil() < finding.until()) {
                close(open, out);
                open = null;
            }
        }
        return open;
    }

    /** Reports it if only the ways came close. */
    static void close(Contact contact, Consumer<Approach> out) {
        if (contact != null && !contact.reportedClose) {
            out.accept(Approach.crossed(contact));
        }
    }

    private boolean isContinuedBy(Finding finding) {
        return until == finding.from() && finding.contactFrom() <= finding.from();
    }

    private Contact joinedBy(Finding finding) {
        Finding closer = finding.distance() < nearest.distance() ? finding : nearest;
        return new Contact(closer, from, finding.until(), reportedClose || finding.reportedClose());
    }
}
