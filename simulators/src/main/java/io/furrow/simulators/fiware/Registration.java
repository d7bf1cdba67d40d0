package io.furrow.simulators.fiware;

import java.net.URI;
import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.UUID;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.event.FiwareScope;

/**
 * What the IoT agent has registered of a device at the context broker: it answers for the commands among the attributes of an entity.
 *
 * @param commands names, at least one
 * @param provider base of the agent
 */
record Registration(FiwareScope scope, String entityId, String entityType, Set<String> commands, URI provider) {
    private static final int ID_LENGTH = 24;
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    /** 24 hexadecimal digits, the same for the same entity. */
    String id() {
        byte[] name = (scope.identity(entityId) + " " + entityType).getBytes(StandardCharsets.UTF_8);
        return UUID.nameUUIDFromBytes(name).toString().replace("-", "").substring(0, ID_LENGTH);
    }

    boolean covers(String id, Optional<String> type) {
        return entityId.equals(id) && (type.isEmpty() || type.get().equals(entityType));
    }

    /** The entity with an attribute for each command that it has none for; before the first measure it has no other. */
    StoredEntity addTo(Optional<StoredEntity> entity) {
        StoredEntity own = entity.orElseGet(
                () -> new StoredEntity(scope, entityId, entityType, Map.of(), Instant.EPOCH, Instant.EPOCH));
        Map<String, Attribute> attributes = new LinkedHashMap<>(own.attributes());
        JsonNode empty = NODES.textNode("");
        for (String command : commands) {
            attributes.putIfAbsent(
                    command, new Attribute("command", empty, NODES.objectNode(), own.created(), own.modified()));
        }
        return new StoredEntity(own.scope(), own.id(), own.type(), attributes, own.created(), own.modified());
    }

    ObjectNode json() {
        ObjectNode json = NODES.objectNode().put("id", id());
        ObjectNode provided = json.putObject("dataProvided");
        provided.putArray("entities").addObject().put("id", entityId).put("type", entityType);
        commands.forEach(provided.putArray("attrs")::add);
        ObjectNode answering = json.putObject("provider");
        answering.putObject("http").put("url", provider.toString());
        answering.put("supportedForwardingMode", "all").put("legacyForwarding", false);
        return json.put("status", "active");
    }
}
