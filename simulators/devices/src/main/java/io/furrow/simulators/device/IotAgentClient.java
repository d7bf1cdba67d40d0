package io.furrow.simulators.device;

import java.io.IOException;
import java.net.http.HttpResponse;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** Registers devices at the IoT Agent; existing registrations stay as they are. */
public final class IotAgentClient {
    private static final int BATCH = 100;
    private static final int ALREADY_THERE = 409;
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private final FleetSettings settings;
    private final FiwareHttp http;

    public IotAgentClient(FleetSettings settings) {
        this.settings = settings;
        this.http = new FiwareHttp(settings);
    }

    /**
     * Creates the service group of a key and registers devices in it.
     *
     * @throws IOException if the agent does not answer or refuses; the message carries its reason
     */
    public void provision(String apiKey, List<DeviceRegistration> devices) throws IOException, InterruptedException {
        ObjectNode group = NODES.objectNode()
                .put("apikey", apiKey)
                .put("resource", settings.iotAgentResource())
                .put("entity_type", "Thing")
                .put("cbroker", settings.contextBroker().toString());
        post("/iot/services", "services", List.of(group));
        List<ObjectNode> bodies =
                devices.stream().map(device -> device.toJson(apiKey)).toList();
        for (int from = 0; from < bodies.size(); from += BATCH) {
            register(bodies.subList(from, Math.min(from + BATCH, bodies.size())));
        }
    }

    /** One registered device makes the agent answer 409 for a whole batch: then each is sent separately. */
    private void register(List<ObjectNode> batch) throws IOException, InterruptedException {
        if (post("/iot/devices", "devices", batch) != ALREADY_THERE || batch.size() == 1) {
            return;
        }
        for (ObjectNode device : batch) {
            post("/iot/devices", "devices", List.of(device));
        }
    }

    private int post(String path, String list, List<? extends JsonNode> members)
            throws IOException, InterruptedException {
        ArrayNode array = NODES.arrayNode();
        members.forEach(array::add);
        HttpResponse<String> answer =
                http.post(settings.iotAgent(), path, NODES.objectNode().set(list, array));
        int status = answer.statusCode();
        if (status / 100 != 2 && status != ALREADY_THERE) {
            throw new IOException("the IoT Agent %s answers %d to POST %s: %s"
                    .formatted(settings.iotAgent(), status, path, answer.body()));
        }
        return status;
    }
}
