package io.furrow.fiware.agent;

import java.util.List;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.http.Call;
import io.furrow.fiware.http.NgsiError;
import io.furrow.fiware.http.Reply;
import io.furrow.model.event.FiwareScope;

/** {@code /iot/devices} and {@code /iot/devices/<id>}. */
final class DeviceResource {
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private final DeviceRegistry registry;

    DeviceResource(DeviceRegistry registry) {
        this.registry = registry;
    }

    Reply answer(Call call) throws NgsiError {
        return switch (call.method()) {
            case "POST" -> create(call);
            case "GET" -> list(call);
            default -> IotAgentApi.notFound(call);
        };
    }

    Reply answer(Call call, String id) throws NgsiError {
        FiwareScope scope = call.scope();
        return switch (call.method()) {
            case "GET" -> Reply.ok(DeviceJson.listed(find(scope, id)));
            case "DELETE" -> {
                registry.remove(scope, id);
                yield Reply.noContent();
            }
            default -> IotAgentApi.notFound(call);
        };
    }

    private Device find(FiwareScope scope, String id) throws NgsiError {
        return registry.device(scope, id).orElseThrow(() -> AgentErrors.noDevice(id));
    }

    /** Creates each device separately; answers the first error. */
    private Reply create(Call call) throws NgsiError {
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
        return Reply.json(201, NODES.objectNode());
    }

    private Device read(FiwareScope scope, JsonNode json) throws NgsiError {
        Optional<ServiceGroup> group = registry.groupFor(
                scope, json.path("apikey").asText(""), json.path("entity_type").asText(""));
        return Device.read(scope, json, group);
    }

    private Reply list(Call call) throws NgsiError {
        List<Device> all = registry.devices(call.scope());
        ArrayNode page = NODES.arrayNode();
        all.stream().skip(call.offset()).limit(call.limit()).forEach(device -> page.add(DeviceJson.listed(device)));
        ObjectNode list = NODES.objectNode().put("count", all.size());
        list.set("devices", page);
        return Reply.ok(list);
    }
}
