package io.furrow.cli.control.table;

import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.control.Limits;
import io.furrow.model.ngsi.NgsiJson;

/** Splits a device list into parts that each fit into a request. */
public final class DeviceListParts {
    /** The rest is for what surrounds the list. */
    private static final int PART_BYTES = Limits.REQUEST_BYTES - 8 * 1024;

    private static final String DEVICES = "devices";

    private DeviceListParts() {}

    /** Splits the member {@code devices} of a request into as many requests as needed; one if it is not a list, or fits. */
    public static List<ObjectNode> requests(ObjectNode whole) {
        List<ObjectNode> requests = new ArrayList<>();
        if (!whole.path(DEVICES).isArray()) {
            return List.of(whole);
        }
        ArrayNode part = add(requests);
        int bytes = 0;
        for (JsonNode device : whole.path(DEVICES)) {
            int length = NgsiJson.write(device).length + 1;
            if (bytes + length > PART_BYTES && bytes > 0) {
                part = add(requests);
                bytes = 0;
            }
            part.add(device);
            bytes += length;
        }
        return requests;
    }

    private static ArrayNode add(List<ObjectNode> requests) {
        requests.add(JsonNodeFactory.instance.objectNode());
        return requests.get(requests.size() - 1).putArray(DEVICES);
    }
}
