package io.furrow.connect.sink.api;

import java.util.Collection;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Set;

import io.furrow.connect.broker.Outcome;

/**
 * Decides when a delivery that causes answers 500 is split to isolate the entities that cause them: at every n-th try
 * in a row, and at the first try if one of its entities was isolated before.
 */
public final class Isolation {
    private static final int MAX_SUSPECTS = 1_000;
    private static final int INTERNAL_SERVER_ERROR = 500;

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
     * @param refuseAfter the try from which an entity is rejected although nothing shows that the context broker
     *     accepts others; 0 for never
     */
    public Isolation(int after, int refuseAfter) {
        this.after = after;
        this.refuseAfter = refuseAfter;
    }

    /** Whether an answer may concern the content of the request; 502, 503 and 504 concern the server. */
    static boolean isMeant(Outcome.Unavailable unavailable) {
        return unavailable.status() == INTERNAL_SERVER_ERROR;
    }

    /** Whether this try splits the delivery. */
    boolean isDue(Collection<EntityChange> changes) {
        if (after == 0) {
            return false;
        }
        boolean suspected = failures == 0
                && !suspects.isEmpty()
                && changes.stream().anyMatch(entityChange -> suspects.contains(entityChange.key()));
        return suspected || (failures + 1) % after == 0;
    }

    /**
     * Whether this try rejects an entity that causes a 500 although no other record of the delivery could be written.
     */
    boolean refusesWithoutProof() {
        return refuseAfter > 0 && failures + 1 >= refuseAfter;
    }

    void suspect(EntityKey key) {
        suspects.add(key);
    }

    /** A try ended with an answer 500. */
    void failed() {
        failures++;
    }

    /** The delivery was written. */
    void passed() {
        failures = 0;
    }
}
