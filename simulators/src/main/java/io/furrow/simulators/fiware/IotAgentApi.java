package io.furrow.simulators.fiware;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.event.FiwareScope;

/** The provisioning API of the IoT agent: {@code /iot/services} (also {@code /iot/groups}), {@code /iot/devices}, {@code /iot/about}. */
final class IotAgentApi implements LoopbackServer.Endpoint {
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private final DeviceRegistry registry;
    private final IotAgent agent;

    IotAgentApi(DeviceRegistry registry, IotAgent agent) {
        this.registry = registry;
        this.agent = agent;
    }

    @Override
    public Reply answer(Call call) throws NgsiError {
        List<String> path = call.path();
        if (path.equals(List.of("iot", "about")) || path.equals(List.of("version"))) {
            return Reply.ok(NODES.objectNode().put("version", "3.14.0-furrow-stand-in"));
        }
        if (path.size() < 2 || path.size() > 3 || !path.get(0).equals("iot")) {
            throw new NgsiError(404, "NOT_FOUND", "no such resource");
        }
        if (!call.hasScopeHeaders()) {
            throw new NgsiError(
                    400,
                    "MISSING_HEADERS",
                    "Some headers were missing from the request: [\"fiware-service\",\"fiware-servicepath\"]");
        }
        return switch (path.get(1)) {
            case "services", "groups" -> services(call);
            case "devices" -> path.size() == 2 ? devices(call) : device(call, path.get(2));
            default -> throw new NgsiError(404, "NOT_FOUND", "no such resource");
        };
    }

    @Override
    public JsonNode describe(NgsiError error) {
        return NODES.objectNode().put("name", error.error()).put("message", error.getMessage());
    }

    private Reply services(Call call) throws NgsiError {
        switch (call.method()) {
            case "POST":
                for (ServiceGroup group : groupsIn(call)) {
                    registry.add(group);
                }
                return created();
            case "GET":
                ArrayNode services = NODES.arrayNode();
                for (ServiceGroup group : registry.groups(call.service(), call.paths())) {
                    services.add(shown(group.json(), group.scope(), "subservice"));
                }
                return Reply.ok(counted("services", services));
            case "DELETE":
                registry.removeGroup(call.scope(), call.parameter("apikey").orElse(""));
                return Reply.noContent();
            default:
                throw NgsiError.badMethod();
        }
    }

    private static List<ServiceGroup> groupsIn(Call call) throws NgsiError {
        JsonNode json = call.json();
        List<ServiceGroup> groups = new ArrayList<>();
        for (JsonNode group : json.has("groups") ? json.get("groups") : json.path("services")) {
            groups.add(ServiceGroup.read(call.scope(), group));
        }
        if (groups.isEmpty()) {
            throw new NgsiError(400, "WRONG_SYNTAX", "Wrong syntax in request: no services");
        }
        return groups;
    }

    private Reply devices(Call call) throws NgsiError {
        switch (call.method()) {
            case "POST":
                for (Device device : devicesIn(call)) {
                    registry.add(device);
                    agent.introduce(device);
                }
                return created();
            case "GET":
                ArrayNode devices = NODES.arrayNode();
                List<Device> all = registry.devices(call.scope());
                all.stream()
                        .skip(EntityQuery.number(call, "offset", 0))
                        .limit(EntityQuery.limit(call))
                        .forEach(device -> devices.add(shown(device)));
                return Reply.ok(counted("devices", devices).put("count", all.size()));
            default:
                throw NgsiError.badMethod();
        }
    }

    private List<Device> devicesIn(Call call) throws NgsiError {
        FiwareScope scope = call.scope();
        List<Device> devices = new ArrayList<>();
        for (JsonNode json : call.json().path("devices")) {
            Optional<ServiceGroup> group = registry.groupFor(
                    scope,
                    json.path("apikey").asText(""),
                    json.path("entity_type").asText(""));
            devices.add(Device.read(scope, json, group));
        }
        if (devices.isEmpty()) {
            throw new NgsiError(400, "WRONG_SYNTAX", "Wrong syntax in request: no devices");
        }
        return devices;
    }

    private Reply device(Call call, String id) throws NgsiError {
        switch (call.method()) {
            case "GET":
                return Reply.ok(shown(registry.require(call.scope(), id)));
            case "DELETE":
                registry.remove(call.scope(), id);
                return Reply.noContent();
            default:
                throw NgsiError.badMethod();
        }
    }

    private static Reply created() {
        return new Reply(201, Optional.of(NODES.objectNode()), Map.of());
    }

    private static ObjectNode counted(String name, ArrayNode items) {
        ObjectNode list = NODES.objectNode().put("count", items.size());
        list.set(name, items);
        return list;
    }

    private static ObjectNode shown(Device device) {
        ObjectNode shown = shown(device.json(), device.scope(), "service_path")
                .put("entity_name", device.entityId())
                .put("entity_type", device.entityType());
        for (String list : Set.of("attributes", "static_attributes", "commands")) {
            if (!shown.has(list)) {
                shown.putArray(list);
            }
        }
        return shown;
    }

    private static ObjectNode shown(ObjectNode provisioned, FiwareScope scope, String pathField) {
        return provisioned.deepCopy().put("service", scope.service()).put(pathField, scope.servicePath());
    }
}
