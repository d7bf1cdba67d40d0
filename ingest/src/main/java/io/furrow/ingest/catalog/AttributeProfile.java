package io.furrow.ingest.catalog;

import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * What the values of an attribute are like.
 *
 * @param type as reported last, for instance {@code Float}; empty if none was
 * @param unit metadata {@code unitCode} or {@code unit} as reported last; empty if none was
 * @param kind {@code number}, {@code text}, {@code boolean}, {@code image}, {@code structure} or {@code mixed}
 * @param values how many, without nulls
 * @param numbers how many of them are numbers
 * @param min of the numbers; positive infinity if there is none
 * @param max of the numbers; negative infinity if there is none
 * @param first event time of the first value, epoch ms
 * @param last event time of the last value, epoch ms
 */
public record AttributeProfile(
        String type,
        String unit,
        String kind,
        long values,
        long numbers,
        double min,
        double max,
        long first,
        long last) {
    static final String IMAGE = "image";

    private static final String MIXED = "mixed";

    /** One value; empty if it is null. */
    static Optional<AttributeProfile> of(JsonNode attribute, long time) {
        JsonNode value = attribute.path("value");
        if (value.isMissingNode() || value.isNull()) {
            return Optional.empty();
        }
        boolean number = value.isNumber() && Double.isFinite(value.doubleValue());
        return Optional.of(new AttributeProfile(
                attribute.path("type").asText(""),
                unit(attribute.path("metadata")),
                kind(value),
                1,
                number ? 1 : 0,
                number ? value.doubleValue() : Double.POSITIVE_INFINITY,
                number ? value.doubleValue() : Double.NEGATIVE_INFINITY,
                time,
                time));
    }

    private static String unit(JsonNode metadata) {
        JsonNode code = metadata.path("unitCode").path("value");
        return code.isTextual()
                ? code.textValue()
                : metadata.path("unit").path("value").asText("");
    }

    private static String kind(JsonNode value) {
        if (value.isObject() && value.has("url") && value.has("sha256")) {
            return IMAGE;
        }
        return value.isNumber() ? "number" : value.isTextual() ? "text" : value.isBoolean() ? "boolean" : "structure";
    }

    /** Both together; in any order the same. */
    AttributeProfile plus(AttributeProfile other) {
        AttributeProfile newer = newer(other);
        return new AttributeProfile(
                newer.type,
                newer.unit,
                kind.equals(other.kind) ? kind : MIXED,
                values + other.values,
                numbers + other.numbers,
                Math.min(min, other.min),
                Math.max(max, other.max),
                Math.min(first, other.first),
                Math.max(last, other.last));
    }

    /** Of the same time the one that is first by type and unit, so that the order of arrival makes no difference. */
    private AttributeProfile newer(AttributeProfile other) {
        if (last != other.last) {
            return last > other.last ? this : other;
        }
        int byName = (type + "\n" + unit).compareTo(other.type + "\n" + other.unit);
        return byName <= 0 ? this : other;
    }

    void writeTo(ObjectNode json) {
        json.put("type", type).put("unit", unit).put("kind", kind).put("values", values);
        if (numbers > 0) {
            json.put("min", min).put("max", max);
        }
        CatalogEntry.writeTimes(json, values, first, last);
    }
}
