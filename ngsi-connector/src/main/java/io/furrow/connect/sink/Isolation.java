package io.furrow.connect.sink;

import java.util.Collection;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Set;

/**
 * Decides when a delivery that draws answers 500 is taken apart, to set the entities aside that draw them: at every n-th try in a
 * row, and at the first where one of its entities was set aside before.
 */
final class Isolation {
    private static final int MAX_SUSPECTS = 1_000;

    private final int after;
    private final int refuseAfter;
    private final Set<EntityKey> suspects = Collections.newSetFromMap(new LinkedHashMap<>() {
        private static final long serialVersionUID = 1L;

        @Override
        protected boolean removeEldestEntry(Map.Entry<EntityKey, Boolean> eldest) {
            return size() > MAX_SUSPECTS;
        }
    });
    private int failures;

    /**
     * @param after n; 0 for never
     * @param refuseAfter the try from which an entity is set aside although nothing shows that the context broker takes others; 0
     *     for none
     */
    Isolation(int after, int refuseAfter) {
        this.after = after;
        this.refuseAfter = refuseAfter;
    }

    /** Whether this try of the delivery takes it apart. */
    boolean isDue(Collection<Change> changes) {
        if (after == 0) {
            return false;
        }
        boolean suspected = failures == 0
                && !suspects.isEmpty()
                && changes.stream().anyMatch(change -> suspects.contains(change.key()));
        return suspected || (failures + 1) % after == 0;
    }

    /** Whether this try sets aside what draws a 500 although nothing of the delivery could be written. */
    boolean refusesWithoutProof() {
        return refuseAfter > 0 && failures + 1 >= refuseAfter;
    }

    void suspect(EntityKey key) {
        suspects.add(key);
    }

    /** A try has ended with an answer 500. */
    void failed() {
        failures++;
    }

    /** The delivery is through. */
    void passed() {
        failures = 0;
    }
}
