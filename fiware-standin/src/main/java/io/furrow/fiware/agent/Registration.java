package io.furrow.fiware.agent;

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

import io.furrow.fiware.broker.Attribute;
import io.furrow.fiware.broker.StoredEntity;
import io.furrow.model.event.FiwareScope;

/**
 * A registration of the IoT agent at the context broker, for the commands of an entity.
 *
 * @param commands names, at least one
 * @param provider base of the agent
 */
public record Registration(FiwareScope scope, String entityId, String entityType, Set<String> commands, URI provider) {
    private static final int ID_LENGTH = 24;
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    /** 24 hexadecimal digits derived from the entity. */
    public String id() {
        byte[] name = (scope.identity(entityId) + " " + entityType).getBytes(StandardCharsets.UTF_8);
        return UUID.nameUUIDFromBytes(name).toString().replace("-", "").substring(0, ID_LENGTH);
    }

    public boolean covers(String id, Optional<String> type) {
        return entityId.equals(id) && (type.isEmpty() || type.get().equals(entityType));
    }

    /** Adds an attribute for each command without one; before the first measure the entity has no others. */
    public StoredEntity addTo(Optional<StoredEntity> entity) {
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

    public ObjectNode json() {
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
