package io.furrow.ingest.route;

import java.util.LinkedHashMap;
import java.util.Map;

import io.furrow.model.event.FiwareScope;

/**
 * Finds ids of entities in several tenants or service paths. Stores nothing until a second tenant or path appears; of more than
 * {@value #MAX_IDS} ids the newest. All records of an id are in one partition, so one instance receives them all.
 */
final class SharedIds {
    static final int MAX_IDS = 100_000;

    private static final String SHARED = "";

    /** Tenant and service path of an id, the prefix of identities. */
    private final Map<String, String> scopes = new LinkedHashMap<>() {
        private static final long serialVersionUID = 1L;

        @Override
        protected boolean removeEldestEntry(Map.Entry<String, String> eldest) {
            return size() > MAX_IDS;
        }
    };

    private String only;
    private boolean areSeveral;

    /** @return tenant and service path of another entity of the id, once per id; null if unknown */
    FiwareScope take(ReportedEvent event) {
        String identity = event.identity();
        String id = event.entityId();
        int end = identity.length() - id.length();
        if (only == null) {
            only = identity.substring(0, end);
        }
        areSeveral |= end != only.length() || !identity.startsWith(only);
        if (!areSeveral) {
            return null;
        }
        String scope = identity.substring(0, end);
        String other = scopes.putIfAbsent(id, scope);
        if (other == null || other.equals(SHARED) || other.equals(scope)) {
            return null;
        }
        scopes.put(id, SHARED);
        return FiwareScope.ofIdentity(other + id);
    }
}
