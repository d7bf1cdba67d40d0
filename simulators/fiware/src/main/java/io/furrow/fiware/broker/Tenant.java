package io.furrow.fiware.broker;

import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.atomic.AtomicLong;

import io.furrow.fiware.http.PathFilter;

/**
 * The entities and subscriptions of a tenant. Entities are guarded by the tenant's monitor, held until notifications
 * are queued, which keeps them in the order of the changes.
 */
public final class Tenant {
    private record Place(String servicePath, String id) {}

    /** By place, then by type; in the order of creation. */
    private final Map<Place, Map<String, StoredEntity>> entities = new LinkedHashMap<>();

    private final List<Subscription> subscriptions = new CopyOnWriteArrayList<>();
    private final AtomicLong revision;

    Tenant(AtomicLong revision) {
        this.revision = revision;
    }

    /** In the order of creation, which is the order of notification. */
    public List<Subscription> subscriptions() {
        return Collections.unmodifiableList(subscriptions);
    }

    public void add(Subscription subscription) {
        subscriptions.add(subscription);
        revision.incrementAndGet();
    }

    public void remove(Subscription subscription) {
        subscriptions.remove(subscription);
        revision.incrementAndGet();
    }

    public synchronized List<StoredEntity> find(String servicePath, String id, Optional<String> type) {
        Map<String, StoredEntity> byType = entities.getOrDefault(new Place(servicePath, id), Map.of());
        return byType.values().stream()
                .filter(entity -> type.isEmpty() || type.get().equals(entity.type()))
                .toList();
    }

    public synchronized List<StoredEntity> find(PathFilter paths, String id, Optional<String> type) {
        if (paths.isOnePath()) {
            return find(paths.patterns().get(0), id, type);
        }
        return all(paths).stream()
                .filter(entity ->
                        entity.id().equals(id) && (type.isEmpty() || type.get().equals(entity.type())))
                .toList();
    }

    public synchronized List<StoredEntity> all(PathFilter paths) {
        List<StoredEntity> all = new ArrayList<>();
        entities.forEach((place, byType) -> {
            if (paths.matches(place.servicePath())) {
                all.addAll(byType.values());
            }
        });
        return all;
    }

    public synchronized void put(StoredEntity entity) {
        entities.computeIfAbsent(place(entity), place -> new LinkedHashMap<>()).put(entity.type(), entity);
        revision.incrementAndGet();
    }

    synchronized void remove(StoredEntity entity) {
        Map<String, StoredEntity> byType = entities.get(place(entity));
        if (byType != null && byType.remove(entity.type()) != null && byType.isEmpty()) {
            entities.remove(place(entity));
        }
        revision.incrementAndGet();
    }

    private static Place place(StoredEntity entity) {
        return new Place(entity.scope().servicePath(), entity.id());
    }
}
