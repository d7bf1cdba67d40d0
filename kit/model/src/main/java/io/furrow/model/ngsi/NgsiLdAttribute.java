package io.furrow.model.ngsi;

import java.util.Map;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.NullNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * Converts an attribute of an NGSI-LD entity to the NGSI-v2 attribute {@code {type, value, metadata}}.
 *
 * <table>
 * <caption>Kinds, detected by {@code type} or, in concise form, from the member with the value</caption>
 * <tr><td>{@code Property}</td><td>type as NGSI-v2 assigns it to such a value ({@code Number}, {@code Text}, {@code Boolean},
 *     {@code StructuredValue}, {@code geo:json}, {@code None}); {@code {"@type": T, "@value": V}} becomes type T, value V</td></tr>
 * <tr><td>{@code GeoProperty}</td><td>type {@code geo:json}, value the geometry</td></tr>
 * <tr><td>{@code Relationship}</td><td>type {@code Relationship}, value of {@code object}</td></tr>
 * <tr><td>{@code LanguageProperty}, {@code VocabProperty}, {@code JsonProperty}, {@code ListProperty},
 *     {@code ListRelationship}</td><td>type the same, value of {@code languageMap}, {@code vocab}, {@code json},
 *     {@code valueList}, {@code objectList}</td></tr>
 * <tr><td>a bare value</td><td>{@code GeoProperty} if it is GeoJSON, else {@code Property}</td></tr>
 * </table>
 *
 * <p>{@code urn:ngsi-ld:null}, which marks a deleted attribute, becomes the value null. {@code observedAt} becomes the
 * metadata {@code TimeInstant}, {@code createdAt} and {@code modifiedAt} {@code dateCreated} and {@code dateModified}
 * (all {@code DateTime}), {@code unitCode} and {@code datasetId} themselves ({@code Text}). Any other member is a
 * sub-attribute: a metadata of its kind and value, or, if it has members of its own beside the value, a
 * {@code StructuredValue} with all of it as reported.
 */
final class NgsiLdAttribute {
    /** The member with the value of each kind. */
    private static final Map<String, String> VALUE_OF = Map.of(
            "Property", "value",
            "GeoProperty", "value",
            "Relationship", "object",
            "LanguageProperty", "languageMap",
            "VocabProperty", "vocab",
            "JsonProperty", "json",
            "ListProperty", "valueList",
            "ListRelationship", "objectList");

    private static final Map<String, String> KIND_OF = Map.of(
            "value", "Property",
            "object", "Relationship",
            "languageMap", "LanguageProperty",
            "vocab", "VocabProperty",
            "json", "JsonProperty",
            "valueList", "ListProperty",
            "objectList", "ListRelationship");

    private static final Map<String, String> TIMES = Map.of(
            "observedAt", "TimeInstant",
            "createdAt", "dateCreated",
            "modifiedAt", "dateModified",
            "deletedAt", "deletedAt");

    private static final String DELETED = "urn:ngsi-ld:null";

    private NgsiLdAttribute() {}

    /** Returns whether the attribute names its kind and has the value of that kind. */
    static boolean isNormalized(JsonNode attribute) {
        String kind = attribute.path("type").textValue();
        return kind != null && VALUE_OF.containsKey(kind) && attribute.has(VALUE_OF.get(kind));
    }

    /** Returns whether it is a list of instances of one attribute, and not a list as the value. */
    static boolean isMultiInstance(JsonNode reported) {
        return reported.isArray()
                && !reported.isEmpty()
                && reported.valueStream().allMatch(each -> kindOf(each).isPresent())
                && reported.valueStream()
                        .anyMatch(each -> each.has("datasetId") || each.has("observedAt") || isNormalized(each));
    }

    static ObjectNode read(JsonNode reported) {
        Optional<String> kind = kindOf(reported);
        if (kind.isEmpty()) {
            return valued("Property", reported);
        }
        String valueMember = VALUE_OF.get(kind.get());
        ObjectNode attribute = valued(kind.get(), reported.get(valueMember));
        ObjectNode metadata = (ObjectNode) attribute.get("metadata");
        for (Map.Entry<String, JsonNode> member : reported.properties()) {
            String name = member.getKey();
            if (!name.equals(valueMember) && !(name.equals("type") && isNormalized(reported))) {
                metadata.set(TIMES.getOrDefault(name, name), metadata(name, member.getValue()));
            }
        }
        return attribute;
    }

    /** Returns an attribute without metadata. */
    static ObjectNode plain(String type, JsonNode value) {
        ObjectNode attribute = JsonNodeFactory.instance.objectNode().put("type", type);
        attribute.set("value", value);
        attribute.set("metadata", JsonNodeFactory.instance.objectNode());
        return attribute;
    }

    /** Returns the kind; empty for a bare value. */
    private static Optional<String> kindOf(JsonNode reported) {
        if (isNormalized(reported)) {
            return Optional.of(reported.get("type").textValue());
        }
        if (!reported.isObject() || NgsiV2Representation.isGeoJson(reported)) {
            return Optional.empty();
        }
        return KIND_OF.entrySet().stream()
                .filter(each -> reported.has(each.getKey()))
                .map(Map.Entry::getValue)
                .sorted()
                .findFirst();
    }

    private static ObjectNode valued(String kind, JsonNode reported) {
        JsonNode value = DELETED.equals(reported.textValue())
                        || DELETED.equals(reported.path("@none").textValue())
                ? NullNode.instance
                : reported;
        boolean typed =
                value.isObject() && value.size() == 2 && value.path("@type").isTextual() && value.has("@value");
        return switch (kind) {
            case "Property" ->
                typed
                        ? plain(value.get("@type").textValue(), value.get("@value"))
                        : plain(NgsiV2Representation.typeOf(value), value);
            case "GeoProperty" -> plain("geo:json", value);
            default -> plain(kind, value);
        };
    }

    private static ObjectNode metadata(String name, JsonNode reported) {
        ObjectNode metadata = JsonNodeFactory.instance.objectNode();
        if (TIMES.containsKey(name) && reported.isTextual()) {
            metadata.put("type", "DateTime");
            metadata.set("value", reported);
            return metadata;
        }
        ObjectNode attribute = read(reported);
        boolean isSimple = attribute.get("metadata").isEmpty();
        metadata.set("type", isSimple ? attribute.get("type") : JsonNodeFactory.instance.textNode("StructuredValue"));
        metadata.set("value", isSimple ? attribute.get("value") : reported);
        return metadata;
    }
}
