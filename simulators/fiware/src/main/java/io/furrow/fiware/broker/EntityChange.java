package io.furrow.fiware.broker;

import java.time.Instant;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.TreeMap;

import io.furrow.fiware.http.NgsiError;
import io.furrow.model.event.FiwareScope;

/**
 * The effect of one request on one entity, matched against subscriptions.
 *
 * <p>A notification lists attributes in the order of {@code after}, by Orion's rule: of a new or replaced entity in the
 * order of the request; of an updated one the previous attributes, sorted by the bytes of their names (as it reads them
 * from its database), then the new ones in the order of the request.
 *
 * @param before empty for a new entity
 * @param after for a deleted entity its last state
 * @param actions by attribute named in the request: {@code append}, {@code update} or {@code delete}
 * @param changed attributes that are new, removed or of another type, value or metadata; all named by a forced update
 */
record EntityChange(
        Kind kind,
        Optional<StoredEntity> before,
        StoredEntity after,
        Map<String, String> actions,
        Set<String> changed) {
    /** Names as in {@code alterationTypes} of a subscription and the built-in attribute {@code alterationType}. */
    public enum Kind {
        CREATE("entityCreate"),
        /** An update with changes, or a forced one. */
        CHANGE("entityChange"),
        /** An update without changes. */
        UPDATE("entityUpdate"),
        DELETE("entityDelete");

        private final String alteration;

        Kind(String alteration) {
            this.alteration = alteration;
        }

        String alteration() {
            return alteration;
        }
    }

    static EntityChange create(FiwareScope scope, EntityUpdate request, Instant now) throws NgsiError {
        Map<String, StoredAttribute> attributes = new LinkedHashMap<>();
        Map<String, String> actions = new LinkedHashMap<>();
        for (Map.Entry<String, AttributeInput> input : request.attributes().entrySet()) {
            attributes.put(input.getKey(), input.getValue().created(now));
            actions.put(input.getKey(), "append");
        }
        String type = request.type().orElse(EntityUpdate.DEFAULT_TYPE);
        StoredEntity entity = new StoredEntity(scope, request.id(), type, attributes, now, now);
        return new EntityChange(Kind.CREATE, Optional.empty(), entity, actions, actions.keySet());
    }

    static EntityChange merge(StoredEntity before, Map<String, AttributeInput> inputs, boolean forced, Instant now)
            throws NgsiError {
        Map<String, StoredAttribute> attributes = sorted(before);
        Map<String, String> actions = new LinkedHashMap<>();
        Set<String> changed = new LinkedHashSet<>();
        for (Map.Entry<String, AttributeInput> input : inputs.entrySet()) {
            String name = input.getKey();
            StoredAttribute old = attributes.get(name);
            StoredAttribute merged = old == null
                    ? input.getValue().created(now)
                    : input.getValue().merged(old, now);
            actions.put(name, old == null ? "append" : "update");
            if (old == null || forced || !merged.sameAs(old)) {
                changed.add(name);
                attributes.put(name, merged);
            }
        }
        return updated(before, attributes, actions, changed, now);
    }

    static EntityChange replace(StoredEntity before, Map<String, AttributeInput> inputs, Instant now) throws NgsiError {
        Map<String, StoredAttribute> attributes = new LinkedHashMap<>();
        Map<String, String> actions = new LinkedHashMap<>();
        for (Map.Entry<String, AttributeInput> input : inputs.entrySet()) {
            attributes.put(input.getKey(), input.getValue().created(now));
            actions.put(input.getKey(), before.attributes().containsKey(input.getKey()) ? "update" : "append");
        }
        for (String name : before.attributes().keySet()) {
            actions.putIfAbsent(name, "delete");
        }
        return updated(before, attributes, actions, actions.keySet(), now);
    }

    static EntityChange without(StoredEntity before, Set<String> names, Instant now) {
        Map<String, StoredAttribute> attributes = sorted(before);
        Map<String, String> actions = new LinkedHashMap<>();
        for (String name : names) {
            if (attributes.remove(name) != null) {
                actions.put(name, "delete");
            }
        }
        return updated(before, attributes, actions, actions.keySet(), now);
    }

    static EntityChange delete(StoredEntity before) {
        return new EntityChange(
                Kind.DELETE,
                Optional.of(before),
                before,
                Map.of(),
                before.attributes().keySet());
    }

    /** Names are ASCII, so the order of characters is the order of bytes. */
    private static Map<String, StoredAttribute> sorted(StoredEntity entity) {
        return new LinkedHashMap<>(new TreeMap<>(entity.attributes()));
    }

    private static EntityChange updated(
            StoredEntity before,
            Map<String, StoredAttribute> attributes,
            Map<String, String> actions,
            Set<String> changed,
            Instant now) {
        StoredEntity after =
                new StoredEntity(before.scope(), before.id(), before.type(), attributes, before.created(), now);
        Kind kind = changed.isEmpty() ? Kind.UPDATE : Kind.CHANGE;
        return new EntityChange(kind, Optional.of(before), after, actions, changed);
    }
}
