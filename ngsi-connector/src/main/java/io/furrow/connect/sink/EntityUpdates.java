package io.furrow.connect.sink;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;

/**
 * Merges several changes of an entity into one update: of each attribute the value with the newest event time, of equal
 * times the one added last. What only the context broker may set is left out, of entities and of metadata.
 */
final class EntityUpdates {
    private static final Set<String> BROKER_METADATA =
            Set.of("dateCreated", "dateModified", "previousValue", "actionType");

    /**
     * An entity as it shall be written.
     *
     * @param entity normalized, without built-ins
     * @param sources the numbers of the changes that it was made of
     */
    record Update(FiwareScope scope, ObjectNode entity, List<Integer> sources) {}

    private record Identity(FiwareScope scope, String id, String type) {}

    private static final class Merged {
        private final ObjectNode entity = JsonNodeFactory.instance.objectNode();
        private final Map<String, Long> times = new HashMap<>();
        private final List<Integer> sources = new ArrayList<>();
    }

    private final Map<Identity, Merged> entities = new LinkedHashMap<>();

    /**
     * @param time event time in epoch milliseconds
     * @param source a number that the update will carry
     */
    void add(FiwareScope scope, Entity change, long time, int source) {
        Merged merged =
                entities.computeIfAbsent(new Identity(scope, change.id(), change.type()), identity -> new Merged());
        merged.entity.put("id", change.id()).put("type", change.type());
        merged.sources.add(source);
        for (Map.Entry<String, JsonNode> attribute : change.attributes()) {
            String name = attribute.getKey();
            if (!Entity.BUILT_INS.contains(name) && time >= merged.times.getOrDefault(name, Long.MIN_VALUE)) {
                merged.times.put(name, time);
                merged.entity.set(name, withoutBrokerMetadata(attribute.getValue()));
            }
        }
    }

    /** In the order in which the entities were first added. */
    List<Update> merged() {
        List<Update> updates = new ArrayList<>(entities.size());
        entities.forEach((identity, merged) ->
                updates.add(new Update(identity.scope(), merged.entity, List.copyOf(merged.sources))));
        return updates;
    }

    private static JsonNode withoutBrokerMetadata(JsonNode attribute) {
        ObjectNode clean = attribute.deepCopy();
        if (clean.path("metadata") instanceof ObjectNode metadata) {
            metadata.remove(BROKER_METADATA);
        }
        return clean;
    }
}
