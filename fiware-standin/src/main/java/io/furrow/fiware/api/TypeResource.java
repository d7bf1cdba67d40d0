package io.furrow.fiware.api;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.TreeSet;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.Call;
import io.furrow.fiware.NgsiError;
import io.furrow.fiware.Reply;
import io.furrow.fiware.broker.ContextBroker;
import io.furrow.fiware.broker.StoredEntity;

/** {@code GET /v2/types}, also with {@code options=values}, and {@code /v2/types/<type>}, in the order of names. */
final class TypeResource {
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private final ContextBroker broker;

    TypeResource(ContextBroker broker) {
        this.broker = broker;
    }

    Reply answer(Call call) throws NgsiError {
        if (call.path().size() > 3) {
            throw NgsiError.noService();
        }
        if (!call.method().equals("GET")) {
            throw NgsiError.badMethod();
        }
        Map<String, List<StoredEntity>> byType = new TreeMap<>();
        for (StoredEntity entity : broker.tenant(call.service()).all(call.paths())) {
            byType.computeIfAbsent(entity.type(), type -> new ArrayList<>()).add(entity);
        }
        if (call.path().size() == 2) {
            return list(call, byType);
        }
        List<StoredEntity> entities = byType.get(call.path().get(2));
        if (entities == null) {
            throw NgsiError.noType();
        }
        return Reply.ok(described(entities));
    }

    private static Reply list(Call call, Map<String, List<StoredEntity>> byType) throws NgsiError {
        ArrayNode page = NODES.arrayNode();
        byType.entrySet().stream()
                .skip(EntityQuery.number(call, "offset", 0))
                .limit(EntityQuery.limit(call))
                .forEach(type -> page.add(call.option("values") ? NODES.textNode(type.getKey()) : described(type)));
        return Reply.page(call, page, byType.size());
    }

    private static JsonNode described(Map.Entry<String, List<StoredEntity>> type) {
        return NODES.objectNode().put("type", type.getKey()).setAll(described(type.getValue()));
    }

    private static ObjectNode described(List<StoredEntity> entities) {
        Map<String, TreeSet<String>> types = new TreeMap<>();
        for (StoredEntity entity : entities) {
            entity.attributes()
                    .forEach((name, attribute) ->
                            types.computeIfAbsent(name, any -> new TreeSet<>()).add(attribute.type()));
        }
        ObjectNode json = NODES.objectNode();
        ObjectNode attributes = json.putObject("attrs");
        types.forEach(
                (name, ofName) -> ofName.forEach(attributes.putObject(name).putArray("types")::add));
        return json.put("count", entities.size());
    }
}
