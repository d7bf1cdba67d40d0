package io.furrow.fiware;

import java.time.Instant;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.atomic.AtomicLong;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.agent.DeviceRegistry;
import io.furrow.fiware.agent.ProvisionedDevice;
import io.furrow.fiware.agent.ServiceGroup;
import io.furrow.fiware.broker.AttributeInput;
import io.furrow.fiware.broker.ContextBroker;
import io.furrow.fiware.broker.NgsiTime;
import io.furrow.fiware.broker.StoredAttribute;
import io.furrow.fiware.broker.StoredEntity;
import io.furrow.fiware.broker.Subscription;
import io.furrow.fiware.broker.Tenant;
import io.furrow.fiware.http.NgsiError;
import io.furrow.fiware.http.PathFilter;
import io.furrow.model.event.FiwareScope;

/**
 * Converts the state of a stand-in to and from JSON objects with one member each: {@code group}, {@code device}, {@code
 * entity} or {@code subscription}. Each object is consistent, all together need not be.
 */
final class StateCodec {
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private final ContextBroker broker;
    private final DeviceRegistry registry;
    private final AtomicLong revision;

    StateCodec(ContextBroker broker, DeviceRegistry registry, AtomicLong revision) {
        this.broker = broker;
        this.registry = registry;
        this.revision = revision;
    }

    /** The objects, each created on iteration; changes do not wait for it. */
    Iterable<ObjectNode> lines() {
        List<ServiceGroup> groups = registry.groups();
        List<ProvisionedDevice> devices = registry.devices();
        Map<String, Tenant> tenants = broker.tenants();
        return () -> Stream.of(
                        groups.stream().map(group -> line("group", json(group))),
                        devices.stream().map(device -> line("device", json(device))),
                        tenants.values().stream()
                                .flatMap(tenant -> tenant.all(PathFilter.of(PathFilter.EVERYWHERE)).stream())
                                .map(entity -> line("entity", json(entity))),
                        tenants.entrySet().stream()
                                .flatMap(tenant -> tenant.getValue().subscriptions().stream()
                                        .map(one ->
                                                line("subscription", one.state().put("service", tenant.getKey())))))
                .flatMap(part -> part)
                .iterator();
    }

    /**
     * Restores one object.
     *
     * @throws IllegalArgumentException if its kind is unknown
     * @throws NgsiError if its content is not valid
     */
    void restore(JsonNode line) throws NgsiError {
        Map.Entry<String, JsonNode> member =
                line.properties().stream().findFirst().orElseThrow(() -> new IllegalArgumentException("an empty line"));
        JsonNode json = member.getValue();
        switch (member.getKey()) {
            case "group" -> registry.add(group(scope(json), json));
            case "device" -> registry.add(device(json));
            case "entity" -> {
                StoredEntity entity = entity(json);
                broker.tenant(entity.scope().service()).put(entity);
            }
            case "subscription" ->
                broker.tenant(json.required("service").asText()).add(Subscription.restored(json, revision));
            default -> throw new IllegalArgumentException("a line of unknown kind: " + member.getKey());
        }
    }

    private static ObjectNode line(String kind, ObjectNode json) {
        return NODES.objectNode().set(kind, json);
    }

    private static ObjectNode scoped(FiwareScope scope) {
        return NODES.objectNode().put("service", scope.service()).put("servicePath", scope.servicePath());
    }

    private static FiwareScope scope(JsonNode json) {
        return new FiwareScope(
                json.required("service").asText(), json.required("servicePath").asText());
    }

    private static ObjectNode json(ServiceGroup group) {
        return scoped(group.scope()).set("provisioned", group.json());
    }

    private static ServiceGroup group(FiwareScope scope, JsonNode json) throws NgsiError {
        return ServiceGroup.read(scope, json.required("provisioned"));
    }

    /** Includes the group as of provisioning, which may have changed or been removed since. */
    private static ObjectNode json(ProvisionedDevice device) {
        ObjectNode json = scoped(device.scope());
        json.set("provisioned", device.json());
        device.group().ifPresent(group -> json.set("group", json(group)));
        return json;
    }

    private static ProvisionedDevice device(JsonNode json) throws NgsiError {
        FiwareScope scope = scope(json);
        Optional<ServiceGroup> group =
                json.has("group") ? Optional.of(group(scope(json.get("group")), json.get("group"))) : Optional.empty();
        return ProvisionedDevice.read(scope, json.required("provisioned"), group);
    }

    private static ObjectNode json(StoredEntity entity) {
        ObjectNode json = scoped(entity.scope())
                .put("id", entity.id())
                .put("type", entity.type())
                .put("created", NgsiTime.format(entity.created()))
                .put("modified", NgsiTime.format(entity.modified()));
        ObjectNode attributes = json.putObject("attributes");
        entity.attributes().forEach((name, attribute) -> attributes.set(name, json(attribute)));
        return json;
    }

    private static ObjectNode json(StoredAttribute attribute) {
        ObjectNode json = NODES.objectNode().put("type", attribute.type());
        json.set("value", attribute.value());
        json.set("metadata", attribute.metadata());
        return json.put("created", NgsiTime.format(attribute.created()))
                .put("modified", NgsiTime.format(attribute.modified()));
    }

    private static StoredEntity entity(JsonNode json) {
        Map<String, StoredAttribute> attributes = new LinkedHashMap<>();
        json.required("attributes")
                .properties()
                .forEach(one -> attributes.put(one.getKey(), attribute(one.getValue())));
        return new StoredEntity(
                scope(json),
                json.required("id").asText(),
                json.required("type").asText(),
                attributes,
                time(json, "created"),
                time(json, "modified"));
    }

    /** Canonicalizes numbers, whose kinds JSON does not distinguish but a comparison does. */
    private static StoredAttribute attribute(JsonNode json) {
        return new StoredAttribute(
                json.required("type").asText(),
                AttributeInput.canonical(json.required("value")),
                object(AttributeInput.canonical(json.required("metadata"))),
                time(json, "created"),
                time(json, "modified"));
    }

    static ObjectNode object(JsonNode json) {
        if (json instanceof ObjectNode object) {
            return object;
        }
        throw new IllegalArgumentException("not a JSON object: " + json.getNodeType());
    }

    private static Instant time(JsonNode json, String field) {
        String text = json.required(field).asText();
        return NgsiTime.parse(text).orElseThrow(() -> new IllegalArgumentException("not a date: " + text));
    }
}
