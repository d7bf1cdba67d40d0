package io.furrow.model.field;

import java.time.DateTimeException;
import java.time.Instant;
import java.time.format.DateTimeFormatter;
import java.time.format.DateTimeFormatterBuilder;
import java.util.Objects;
import java.util.Set;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * A field from a time on until its next version: a record of {@code service.fields}, key = {@link #key()}, value =
 * {@link #toBytes()}, a GeoJSON Feature (RFC 7946). A record without a value removes the version of its key as if it
 * had never existed.
 *
 * @param id valid in an entity id, see {@link #isId}
 * @param validFrom event time from which this version is valid, epoch ms
 * @param geometry GeoJSON of a Polygon or MultiPolygon with unchecked coordinates; null if the field ends
 * @param properties other properties, without {@code validFrom}; owned by the version, not to be changed by readers
 */
public record FieldVersion(String id, long validFrom, ObjectNode geometry, ObjectNode properties) {
    private static final String VALID_FROM = "validFrom";
    static final Set<String> AREAS = Set.of("Polygon", "MultiPolygon");
    /** Characters of an entity id (NGSI-v2, "Field syntax restrictions"), with room for the prefix of a result's id. */
    public static final Pattern ID = Pattern.compile("[!-~&&[^&?/#<>\"'=;()]]{1,200}");

    private static final DateTimeFormatter UTC_MILLIS =
            new DateTimeFormatterBuilder().appendInstant(3).toFormatter();

    /** The key of a version among those of all fields. */
    public record Key(String id, long validFrom) {
        /**
         * Parses a record's key with a time in ISO 8601 with any offset.
         *
         * @throws UnreadableException with {@link Reason#NOT_AN_EVENT}
         */
        public static Key parse(String key) throws UnreadableException {
            int at = key.lastIndexOf('@');
            if (at < 1) {
                throw rejected("the key '" + key + "' is not a <field id>@<time>");
            }
            return new Key(key.substring(0, at), time(key.substring(at + 1)));
        }

        /** Returns the canonical key, with the time in UTC and milliseconds. */
        @Override
        public String toString() {
            return id + "@" + iso(validFrom);
        }
    }

    public FieldVersion {
        Objects.requireNonNull(id);
        Objects.requireNonNull(properties);
    }

    /** Returns whether the context broker accepts it as (the end of) an entity id. */
    public static boolean isId(String id) {
        return ID.matcher(id).matches();
    }

    /**
     * Reads the value of a record: a Feature with {@code id} (text or whole number), {@code geometry} (null if the
     * field ends, never missing) and {@code properties.validFrom}. Unknown members are ignored.
     *
     * @throws UnreadableException with {@link Reason#NOT_JSON}, or {@link Reason#NOT_AN_EVENT} if it is not such a
     * Feature
     */
    public static FieldVersion read(byte[] value) throws UnreadableException {
        JsonNode feature = NgsiJson.read(value);
        if (!feature.path("type").asText().equals("Feature")) {
            throw rejected("the field is not a GeoJSON Feature");
        }
        JsonNode id = feature.path("id");
        if (!(id.isTextual() || id.isIntegralNumber()) || !isId(id.asText())) {
            throw rejected("the field has no member 'id' of 1 to 200 characters that are allowed in an entity id");
        }
        if (!(feature.path("properties") instanceof ObjectNode original)) {
            throw rejected("'properties' of the field is not an object");
        }
        ObjectNode properties = original.deepCopy();
        JsonNode validFrom = properties.remove(VALID_FROM);
        if (validFrom == null || !validFrom.isTextual()) {
            throw rejected("the field has no property 'validFrom' with a text");
        }
        return new FieldVersion(id.asText(), time(validFrom.textValue()), area(feature.get("geometry")), properties);
    }

    private static ObjectNode area(JsonNode geometry) throws UnreadableException {
        if (geometry == null) {
            throw rejected("the field has no member 'geometry'; null says that the field ends");
        }
        if (geometry.isNull()) {
            return null;
        }
        if (!AREAS.contains(geometry.path("type").asText())) {
            throw rejected("'geometry' of the field is neither a Polygon nor a MultiPolygon");
        }
        return (ObjectNode) geometry;
    }

    /** Parses a time of {@code validFrom} or a key, ISO 8601 with an offset, to epoch ms. */
    private static long time(String iso) throws UnreadableException {
        try {
            return Instant.parse(iso).toEpochMilli();
        } catch (DateTimeException | ArithmeticException e) {
            throw new UnreadableException(
                    Reason.NOT_AN_EVENT, "'" + iso + "' is not a time; write for instance 2026-03-01T00:00:00.000Z", e);
        }
    }

    /** Returns the record's key: {@code <id>@<validFrom>}, with the time in UTC and milliseconds. */
    public String key() {
        return new Key(id, validFrom).toString();
    }

    /** Returns whether the field ends with this version. */
    public boolean isEnd() {
        return geometry == null;
    }

    /** Returns the field's name; empty if it has none. */
    public String name() {
        return properties.path("name").asText("");
    }

    /** Returns the domain of the field; empty if it has none. */
    public String domain() {
        return properties.path("Domain").asText("");
    }

    /** Returns whether its {@code kind} is {@code exclusion}: an area in which devices may be close to each other. */
    public boolean isExclusion() {
        return properties.path("kind").asText("").equals("exclusion");
    }

    /** Returns the Feature as UTF-8 JSON. */
    public byte[] toBytes() {
        ObjectNode feature = NgsiJson.object().put("type", "Feature").put("id", id);
        feature.set("geometry", geometry);
        ObjectNode all = NgsiJson.object().put(VALID_FROM, iso(validFrom));
        feature.set("properties", all.setAll(properties));
        return NgsiJson.write(feature);
    }

    private static String iso(long time) {
        return UTC_MILLIS.format(Instant.ofEpochMilli(time));
    }

    private static UnreadableException rejected(String reason) {
        return new UnreadableException(Reason.NOT_AN_EVENT, reason);
    }
}
