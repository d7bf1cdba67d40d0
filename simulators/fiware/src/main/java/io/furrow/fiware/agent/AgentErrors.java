package io.furrow.fiware.agent;

import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.http.NgsiError;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;

/** The errors of the IoT agent, with its status codes, names and messages. */
final class AgentErrors {
    private AgentErrors() {}

    /** @param names of headers or query parameters: the agent reports both alike */
    static NgsiError missingHeaders(List<String> names) {
        return new NgsiError(
                400,
                "MISSING_HEADERS",
                "Some headers were missing from the request: "
                        + NgsiJson.mapper().valueToTree(names));
    }

    static NgsiError wrongSyntax() {
        return new NgsiError(400, "WRONG_SYNTAX", "Wrong syntax in request: Errors found validating request.");
    }

    static NgsiError notJson() {
        return new NgsiError(500, "SyntaxError", "the body of the request is not JSON");
    }

    /** @param field a tenant or a resource @param value the service path or the API key with it */
    static NgsiError noGroup(String field, String value) {
        return new NgsiError(
                404,
                "DEVICE_GROUP_NOT_FOUND",
                "Couldn\t find device group for fields: \"" + field + "\" and values: \"" + value + "\"");
    }

    static NgsiError duplicateGroup(ServiceGroup group) {
        return new NgsiError(
                409,
                "DUPLICATE_GROUP",
                "A device configuration already exists for resource " + group.resource() + " and API Key "
                        + group.apikey() + " and " + group.internal());
    }

    static NgsiError missingAttributes(JsonNode device) {
        return new NgsiError(
                400,
                "MISSING_ATTRIBUTES",
                "The request was not well formed:Missing attributes: [\"device_id\"] with: " + device);
    }

    static NgsiError duplicateDevice(ProvisionedDevice device) {
        return new NgsiError(
                409,
                "DUPLICATE_DEVICE_ID",
                "A device with the same info (DeviceId, ApiKey, Service, Subservice) was found:" + device.id() + " and "
                        + DeviceJson.internal(device));
    }

    static NgsiError noDevice(String id) {
        return noDevice(id, "undefined");
    }

    static NgsiError noDevice(String id, FiwareScope scope) {
        ObjectNode where = JsonNodeFactory.instance
                .objectNode()
                .put("service", scope.service())
                .put("subservice", scope.servicePath());
        return noDevice(id, where.toString());
    }

    private static NgsiError noDevice(String id, String where) {
        return new NgsiError(404, "DEVICE_NOT_FOUND", "No device was found with id:" + id + " and " + where);
    }
}
