package io.furrow.ingest.catalog;

import java.util.Optional;

import com.fasterxml.jackson.core.JsonToken;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.SlicedEntity;
import io.furrow.model.ngsi.UnreadableException;

/**
 * A profile of an attribute's values.
 *
 * @param type last reported, for instance {@code Float}; empty if there was none
 * @param unit last reported metadata {@code unitCode} or {@code unit}; empty if there was none
 * @param kind {@code number}, {@code text}, {@code boolean}, {@code image}, {@code structure} or {@code mixed}
 * @param values number of values, without nulls
 * @param numbers number of numeric values
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

    /** The profile of one value; empty if it is null. */
    static Optional<AttributeProfile> of(SlicedEntity.Slice attribute, long time) throws UnreadableException {
        if (attribute.value() == JsonToken.VALUE_NULL) {
            return Optional.empty();
        }
        boolean number = Double.isFinite(attribute.number());
        return Optional.of(new AttributeProfile(
                attribute.type(),
                attribute.unit(),
                kind(attribute),
                1,
                number ? 1 : 0,
                number ? attribute.number() : Double.POSITIVE_INFINITY,
                number ? attribute.number() : Double.NEGATIVE_INFINITY,
                time,
                time));
    }

    private static String kind(SlicedEntity.Slice attribute) throws UnreadableException {
        return switch (attribute.value()) {
            case VALUE_NUMBER_INT, VALUE_NUMBER_FLOAT -> "number";
            case VALUE_STRING -> "text";
            case VALUE_TRUE, VALUE_FALSE -> "boolean";
            case START_OBJECT -> {
                JsonNode value = attribute.tree();
                yield value.has("url") && value.has("sha256") ? IMAGE : "structure";
            }
            default -> "structure";
        };
    }

    /** Merges both; commutative and associative. */
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

    /** At equal times the first by type and unit, so that the order of arrival makes no difference. */
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
