package io.furrow.fiware.agent;

import java.util.ArrayList;
import java.util.List;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.http.NgsiError;
import io.furrow.fiware.http.NgsiRequest;
import io.furrow.fiware.http.NgsiResponse;
import io.furrow.model.event.FiwareScope;

/** {@code /iot/services}. Lists ignore {@code limit} and {@code offset}, as the agent does. */
final class ServiceGroupResource {
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private final DeviceRegistry registry;

    ServiceGroupResource(DeviceRegistry registry) {
        this.registry = registry;
    }

    NgsiResponse answer(NgsiRequest call) throws NgsiError {
        return switch (call.method()) {
            case "POST" -> create(call);
            case "GET" -> list(call);
            case "PUT" -> {
                registry.change(key(call), call.scope(), ServiceGroup.members(IotAgentApi.json(call)));
                yield NgsiResponse.noContent();
            }
            case "DELETE" -> {
                registry.removeGroup(key(call), call.scope());
                yield NgsiResponse.noContent();
            }
            default -> IotAgentApi.notFound(call);
        };
    }

    private NgsiResponse create(NgsiRequest call) throws NgsiError {
        JsonNode json = IotAgentApi.json(call);
        JsonNode list = json.path("services");
        if (!list.isArray()) {
            throw AgentErrors.wrongSyntax();
        }
        List<ServiceGroup> groups = new ArrayList<>();
        for (JsonNode group : list) {
            groups.add(ServiceGroup.read(call.scope(), group));
        }
        for (ServiceGroup group : groups) {
            registry.add(group);
        }
        return NgsiResponse.json(201, NODES.objectNode());
    }

    private NgsiResponse list(NgsiRequest call) throws NgsiError {
        FiwareScope scope = call.scope();
        ArrayNode services = NODES.arrayNode();
        registry.groups(scope).forEach(group -> services.add(group.listed()));
        if (services.isEmpty()) {
            throw AgentErrors.noGroup(scope.service(), scope.servicePath());
        }
        ObjectNode list = NODES.objectNode().put("count", services.size());
        list.set("services", services);
        return NgsiResponse.ok(list);
    }

    /** Both parameters are required, but may be empty. */
    private static ServiceGroup.Key key(NgsiRequest call) throws NgsiError {
        List<String> missing = Stream.of("resource", "apikey")
                .filter(name -> call.query().get(name) == null)
                .toList();
        if (!missing.isEmpty()) {
            throw AgentErrors.missingHeaders(missing);
        }
        return new ServiceGroup.Key(
                call.query().getValue("resource"), call.query().getValue("apikey"));
    }
}
