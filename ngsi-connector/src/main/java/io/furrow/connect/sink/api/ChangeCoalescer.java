package io.furrow.connect.sink.api;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.Entity;

/**
 * Merges the changes of a delivery into one update per entity: per attribute the value with the newest event time, the
 * last one if times are equal, and no value older than the known state of the context broker. A deletion removes all
 * values that are not newer.
 */
final class ChangeCoalescer {
    private static final Set<String> BROKER_METADATA =
            Set.of("dateCreated", "dateModified", "previousValue", "actionType");

    private final EntityTimesCache known;
    private final Map<EntityKey, Pending> entities = new LinkedHashMap<>();
    private int stale;
    private int coalesced;

    /** @param known must contain every added entity */
    ChangeCoalescer(EntityTimesCache known) {
        this.known = known;
    }

    private static final class Pending {
        private final EntityTimes known;
        private final Map<String, Merged> byType = new LinkedHashMap<>(2);
        /** By type, empty for all types. */
        private final Map<String, EntityChange> deletions = new LinkedHashMap<>(2);
        /** The keys of those that no attribute outlives. */
        private final Set<String> complete = new HashSet<>(2);

        Pending(EntityTimes known) {
            this.known = known;
        }

        /** The newest time of what a deletion is about. */
        long newest(EntityChange deletion) {
            return Stream.concat(
                            Stream.of(known.newest(type -> deletion.deletes(type) && !isDeleted(type))),
                            byType.entrySet().stream()
                                    .filter(of -> deletion.deletes(of.getKey()))
                                    .flatMap(of -> of.getValue().times.values().stream()))
                    .max(Comparator.naturalOrder())
                    .orElseThrow();
        }

        private boolean isDeleted(String type) {
            return complete.contains("") || complete.contains(type);
        }

        long deletedAt(String type) {
            return Stream.of("", type)
                    .filter(deletions::containsKey)
                    .map(of -> deletions.get(of).time())
                    .reduce(known.deletedAt(type), Math::max);
        }

        long time(Merged merged, String type, String name) {
            Long pending = merged.times.get(name);
            return pending != null ? pending : isDeleted(type) ? EntityChange.NO_TIME : known.of(type, name);
        }
    }

    private static final class Merged {
        private final Map<String, ObjectNode> attributes = new LinkedHashMap<>();
        private final Map<String, Long> times = new HashMap<>();
        private final List<EntityChange> changes = new ArrayList<>(1);
    }

    void add(EntityChange entityChange) {
        Pending pending = entities.computeIfAbsent(entityChange.key(), key -> new Pending(known.of(key)));
        if (entityChange.isDeletion()) {
            delete(pending, entityChange);
        } else if (entityChange.time() < pending.deletedAt(entityChange.type())) {
            stale++;
        } else {
            merge(pending, entityChange);
        }
    }

    private void delete(Pending pending, EntityChange deletion) {
        if (deletion.time() < pending.deletedAt(deletion.type())) {
            stale++;
            return;
        }
        if (pending.newest(deletion) <= deletion.time()) {
            pending.complete.add(deletion.type());
        }
        pending.byType
                .entrySet()
                .removeIf(of -> deletion.deletes(of.getKey()) && wiped(of.getValue(), deletion.time()));
        coalesced += pending.deletions.put(deletion.type(), deletion) == null ? 0 : 1;
    }

    /** Removes the attributes that are not newer; true if nothing is left. */
    private boolean wiped(Merged merged, long time) {
        merged.times.values().removeIf(of -> of <= time);
        merged.attributes.keySet().retainAll(merged.times.keySet());
        if (merged.attributes.isEmpty()) {
            coalesced += merged.changes.size();
        }
        return merged.attributes.isEmpty();
    }

    private void merge(Pending pending, EntityChange entityChange) {
        String type = entityChange.type();
        Merged merged = pending.byType.computeIfAbsent(type, any -> new Merged());
        boolean says = false;
        boolean bare = true;
        for (Map.Entry<String, JsonNode> attribute : entityChange.entity().attributes()) {
            String name = attribute.getKey();
            if (Entity.BUILT_INS.contains(name)) {
                continue;
            }
            bare = false;
            if (entityChange.time() >= pending.time(merged, type, name)) {
                merged.times.put(name, entityChange.time());
                merged.attributes.put(name, withoutBrokerMetadata(attribute.getValue()));
                says = true;
            }
        }
        if (says || bare && pending.known.size() == 0) {
            merged.changes.add(entityChange);
        } else {
            stale++;
            if (merged.changes.isEmpty()) {
                pending.byType.remove(type);
            }
        }
    }

    /** The plan, in the order in which the entities were first added. */
    DeliveryPlan plan() {
        List<EntityChange> deletions = new ArrayList<>();
        List<EntityChange> partial = new ArrayList<>();
        List<AttributeUpdate> updates = new ArrayList<>(entities.size());
        int merges = 0;
        for (Map.Entry<EntityKey, Pending> entity : entities.entrySet()) {
            Pending pending = entity.getValue();
            pending.deletions.forEach(
                    (type, deletion) -> (pending.complete.contains(type) ? deletions : partial).add(deletion));
            for (Map.Entry<String, Merged> of : pending.byType.entrySet()) {
                Merged merged = of.getValue();
                updates.add(new AttributeUpdate(
                        entity.getKey(), of.getKey(), merged.attributes, merged.times, merged.changes));
                merges += merged.changes.size() - 1;
            }
        }
        return new DeliveryPlan(deletions, partial, updates, stale, coalesced + merges);
    }

    private static ObjectNode withoutBrokerMetadata(JsonNode attribute) {
        ObjectNode clean = JsonNodeFactory.instance.objectNode();
        clean.set("type", attribute.get("type"));
        clean.set("value", attribute.get("value"));
        ObjectNode metadata = clean.putObject("metadata");
        attribute.path("metadata").properties().forEach(item -> {
            if (!BROKER_METADATA.contains(item.getKey())) {
                metadata.set(item.getKey(), item.getValue());
            }
        });
        return clean;
    }
}
