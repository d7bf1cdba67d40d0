package io.furrow.fiware.agent;

import java.util.List;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.http.LoopbackServer;
import io.furrow.fiware.http.NgsiError;
import io.furrow.fiware.http.NgsiRequest;
import io.furrow.fiware.http.NgsiResponse;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Routes the provisioning API of the IoT agent: {@code /iot/services}, {@code /iot/devices}, {@code /iot/about}.
 */
public final class IotAgentApi implements LoopbackServer.Endpoint {
    private static final String PAGE = """
            <!DOCTYPE html>
            <html lang="en">
            <head>
            <meta charset="utf-8">
            <title>Error</title>
            </head>
            <body>
            <pre>Cannot %s %s</pre>
            </body>
            </html>
            """;

    private final ServiceGroupResource groups;
    private final DeviceResource devices;

    public IotAgentApi(DeviceRegistry registry) {
        this.groups = new ServiceGroupResource(registry);
        this.devices = new DeviceResource(registry);
    }

    @Override
    public NgsiResponse answer(NgsiRequest call) throws NgsiError {
        List<String> path = call.path();
        if (path.equals(List.of("iot", "about"))) {
            return NgsiResponse.ok(JsonNodeFactory.instance.objectNode().put("version", "3.14.0-furrow-stand-in"));
        }
        String resource = path.size() > 1 && path.get(0).equals("iot") ? path.get(1) : "";
        boolean ofGroups = path.size() == 2 && resource.equals("services");
        boolean ofDevices = path.size() <= 3 && resource.equals("devices");
        if (!ofGroups && !ofDevices) {
            return notFound(call);
        }
        List<String> missing = Stream.of(NgsiRequest.SERVICE, NgsiRequest.SERVICE_PATH)
                .filter(call::lacks)
                .toList();
        if (!missing.isEmpty()) {
            throw AgentErrors.missingHeaders(missing);
        }
        if (ofGroups) {
            return groups.answer(call);
        }
        return path.size() == 2 ? devices.answer(call) : devices.answer(call, path.get(2));
    }

    /** Express' page for an unknown route. */
    static NgsiResponse notFound(NgsiRequest call) {
        return NgsiResponse.html(404, PAGE.formatted(call.method(), "/" + String.join("/", call.path())));
    }

    /** The body; no body is an empty object. */
    static JsonNode json(NgsiRequest call) throws NgsiError {
        if (call.body().length == 0) {
            return JsonNodeFactory.instance.objectNode();
        }
        call.requireJson();
        try {
            return NgsiJson.read(call.body());
        } catch (UnreadableException e) {
            throw AgentErrors.notJson();
        }
    }

    @Override
    public NgsiResponse describe(NgsiError error) {
        ObjectNode json = JsonNodeFactory.instance.objectNode().put("name", error.error());
        return NgsiResponse.json(error.status(), json.put("message", error.getMessage()));
    }
}
