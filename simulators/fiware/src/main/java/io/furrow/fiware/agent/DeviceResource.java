package io.furrow.fiware.agent;

import java.util.List;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.http.NgsiError;
import io.furrow.fiware.http.NgsiRequest;
import io.furrow.fiware.http.NgsiResponse;
import io.furrow.model.event.FiwareScope;

/** {@code /iot/devices} and {@code /iot/devices/<id>}. */
final class DeviceResource {
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private final DeviceRegistry registry;

    DeviceResource(DeviceRegistry registry) {
        this.registry = registry;
    }

    NgsiResponse answer(NgsiRequest call) throws NgsiError {
        return switch (call.method()) {
            case "POST" -> create(call);
            case "GET" -> list(call);
            default -> IotAgentApi.notFound(call);
        };
    }

    NgsiResponse answer(NgsiRequest call, String id) throws NgsiError {
        FiwareScope scope = call.scope();
        return switch (call.method()) {
            case "GET" -> NgsiResponse.ok(DeviceJson.listed(find(scope, id)));
            case "DELETE" -> {
                registry.remove(scope, id);
                yield NgsiResponse.noContent();
            }
            default -> IotAgentApi.notFound(call);
        };
    }

    private ProvisionedDevice find(FiwareScope scope, String id) throws NgsiError {
        return registry.device(scope, id).orElseThrow(() -> AgentErrors.noDevice(id));
    }

    /** Creates each device separately; answers the first error. */
    private NgsiResponse create(NgsiRequest call) throws NgsiError {
        JsonNode devices = IotAgentApi.json(call).path("devices");
        if (!devices.isArray()) {
            throw AgentErrors.wrongSyntax();
        }
        FiwareScope scope = call.scope();
        NgsiError first = null;
        for (JsonNode json : devices) {
            try {
                registry.add(read(scope, json));
            } catch (NgsiError e) {
                first = first == null ? e : first;
            }
        }
        if (first != null) {
            throw first;
        }
        return NgsiResponse.json(201, NODES.objectNode());
    }

    private ProvisionedDevice read(FiwareScope scope, JsonNode json) throws NgsiError {
        Optional<ServiceGroup> group = registry.groupFor(
                scope, json.path("apikey").asText(""), json.path("entity_type").asText(""));
        return ProvisionedDevice.read(scope, json, group);
    }

    private NgsiResponse list(NgsiRequest call) throws NgsiError {
        List<ProvisionedDevice> all = registry.devices(call.scope());
        ArrayNode page = NODES.arrayNode();
        all.stream().skip(call.offset()).limit(call.limit()).forEach(device -> page.add(DeviceJson.listed(device)));
        ObjectNode list = NODES.objectNode().put("count", all.size());
        list.set("devices", page);
        return NgsiResponse.ok(list);
    }
}
