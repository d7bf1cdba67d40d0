package io.furrow.connect.sink.api;

import java.time.Instant;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * Converts an NGSI-v2 entity to NGSI-LD. An id that is not a URI becomes {@code urn:ngsi-ld:<type>:<id>}. An attribute of type
 * {@code Relationship} becomes a Relationship; {@code geo:json}, or {@code geo:point} ("latitude, longitude"), a GeoProperty; all
 * others a Property, dates with {@code @type}. Metadata {@code unitCode} stays a member, all other metadata become Properties of
 * the Property. Null values are omitted: NGSI-LD has no null, and brokers understand {@code urn:ngsi-ld:null} in a merge of one
 * entity only. In an upsert Scorpio stores that text, Stellio rejects it.
 */
final class NgsiLdCodec {
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;
    private static final Pattern URI = Pattern.compile("[A-Za-z][A-Za-z0-9+.-]*:\\S+");
    /** Metadata that are represented otherwise, or set by the broker. */
    private static final Set<String> MEMBERS =
            Set.of("unitCode", "observedAt", "TimeInstant", "timestamp", "createdAt", "modifiedAt", "datasetId");

    private NgsiLdCodec() {}

    static boolean isUri(String id) {
        return URI.matcher(id).matches();
    }

    static String id(String id, String type) {
        return isUri(id) ? id : "urn:ngsi-ld:" + type + ":" + NgsiV2.encoded(id);
    }

    static ObjectNode of(AttributeUpdate attributeUpdate) {
        ObjectNode entity = NODES.objectNode();
        entity.put("id", id(attributeUpdate.key().id(), attributeUpdate.type())).put("type", attributeUpdate.type());
        attributeUpdate.attributes().forEach((name, attribute) -> {
            ObjectNode written = attribute(name, attribute);
            if (written != null) {
                long time = attributeUpdate.times().get(name);
                if (time != EntityChange.NO_TIME) {
                    written.put("observedAt", Instant.ofEpochMilli(time).toString());
                }
                entity.set(name, written);
            }
        });
        return entity;
    }

    /** Null if the value is null. */
    private static ObjectNode attribute(String name, JsonNode attribute) {
        if (isNull(attribute)) {
            return null;
        }
        JsonNode value = attribute.path("value");
        String type = attribute.path("type").asText();
        ObjectNode written = NODES.objectNode();
        Optional<JsonNode> geometry = geometry(type, value);
        if (type.equals("Relationship")) {
            written.put("type", "Relationship").set("object", object(name, value));
        } else if (geometry.isPresent()) {
            written.put("type", "GeoProperty").set("value", geometry.get());
        } else {
            written.put("type", "Property").set("value", plain(type, value));
        }
        metadata(attribute.path("metadata"), written);
        return written;
    }

    static boolean isNull(JsonNode attribute) {
        return attribute.path("value").isNull() || attribute.path("value").isMissingNode();
    }

    private static JsonNode object(String name, JsonNode value) {
        if (value.isArray()) {
            ArrayNode objects = NODES.arrayNode();
            value.forEach(one -> objects.add(object(name, one)));
            return objects;
        }
        return NODES.textNode(id(value.asText(), name));
    }

    private static Optional<JsonNode> geometry(String type, JsonNode value) {
        if (value.path("type").isTextual() && value.path("coordinates").isArray()) {
            return Optional.of(value);
        }
        String[] parts = type.equals("geo:point") && value.isTextual()
                ? value.textValue().split(",")
                : new String[0];
        if (parts.length != 2) {
            return Optional.empty();
        }
        try {
            ObjectNode point = NODES.objectNode().put("type", "Point");
            point.putArray("coordinates")
                    .add(Double.parseDouble(parts[1].trim()))
                    .add(Double.parseDouble(parts[0].trim()));
            return Optional.of(point);
        } catch (NumberFormatException e) {
            return Optional.empty();
        }
    }

    private static JsonNode plain(String type, JsonNode value) {
        if (value.isTextual() && (type.equals("DateTime") || type.equals("ISO8601"))) {
            ObjectNode date = NODES.objectNode();
            date.put("@type", "DateTime").set("@value", value);
            return date;
        }
        return value;
    }

    private static void metadata(JsonNode metadata, ObjectNode written) {
        JsonNode unit = metadata.path("unitCode").path("value");
        if (unit.isTextual()) {
            written.set("unitCode", unit);
        }
        for (Map.Entry<String, JsonNode> item : metadata.properties()) {
            JsonNode value = item.getValue().path("value");
            if (!MEMBERS.contains(item.getKey()) && !value.isNull() && !value.isMissingNode()) {
                written.putObject(item.getKey())
                        .put("type", "Property")
                        .set("value", plain(item.getValue().path("type").asText(), value));
            }
        }
    }
}
