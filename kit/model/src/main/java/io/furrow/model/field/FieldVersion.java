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
 * A field as it is from a time on, until its next version: a record of {@code service.fields}, key = {@link #key()}, value =
 * {@link #toBytes()}, a GeoJSON Feature (RFC 7946). A record without a value takes the version of its key away, as if it had
 * never been.
 *
 * @param id what an entity id may hold, see {@link #isId}
 * @param validFrom event time from which on this holds, epoch ms
 * @param geometry GeoJSON of a Polygon or MultiPolygon, its coordinates not looked at; null if the field ends
 * @param properties what else is said of it, without {@code validFrom}; owned by the version, not to be changed by readers
 */
public record FieldVersion(String id, long validFrom, ObjectNode geometry, ObjectNode properties) {
    private static final String VALID_FROM = "validFrom";
    private static final Set<String> AREAS = Set.of("Polygon", "MultiPolygon");
    /** What may stand in an entity id (NGSI-v2, "Field syntax restrictions"), with room for the prefix of a result's. */
    private static final Pattern ID = Pattern.compile("[!-~&&[^&?/#<>\"'=;()]]{1,200}");

    private static final DateTimeFormatter UTC_MILLIS =
            new DateTimeFormatterBuilder().appendInstant(3).toFormatter();

    /** The key that distinguishes the versions of all fields. */
    public record Key(String id, long validFrom) {
        /**
         * Reads a record's key, its time in ISO 8601 with any offset.
         *
         * @throws UnreadableException with {@link Reason#NOT_AN_EVENT}
         */
        public static Key parse(String key) throws UnreadableException {
            int at = key.lastIndexOf('@');
            if (at < 1) {
                throw refused("the key '" + key + "' is not a <field id>@<time>");
            }
            return new Key(key.substring(0, at), time(key.substring(at + 1)));
        }

        /** In its one spelling, the time in UTC with milliseconds. */
        @Override
        public String toString() {
            return id + "@" + iso(validFrom);
        }
    }

    public FieldVersion {
        Objects.requireNonNull(id);
        Objects.requireNonNull(properties);
    }

    /** Whether the context broker would take it as (the end of) an entity id: 1 to 200 of ASCII, some signs excepted. */
    public static boolean isId(String id) {
        return ID.matcher(id).matches();
    }

    /**
     * Reads the value of a record: a Feature with {@code id} (text or whole number), {@code geometry} (null if the field
     * ends, never missing) and {@code properties.validFrom}. Members of other names are skipped.
     *
     * @throws UnreadableException with {@link Reason#NOT_JSON}, or {@link Reason#NOT_AN_EVENT} where it is no such Feature
     */
    public static FieldVersion read(byte[] value) throws UnreadableException {
        JsonNode feature = NgsiJson.read(value);
        if (!feature.path("type").asText().equals("Feature")) {
            throw refused("the field is not a GeoJSON Feature");
        }
        JsonNode id = feature.path("id");
        if (!(id.isTextual() || id.isIntegralNumber()) || !isId(id.asText())) {
            throw refused("the field has no member 'id' of 1 to 200 characters that are allowed in an entity id");
        }
        if (!(feature.path("properties") instanceof ObjectNode said)) {
            throw refused("'properties' of the field is not an object");
        }
        ObjectNode properties = said.deepCopy();
        JsonNode validFrom = properties.remove(VALID_FROM);
        if (validFrom == null || !validFrom.isTextual()) {
            throw refused("the field has no property 'validFrom' with a text");
        }
        return new FieldVersion(id.asText(), time(validFrom.textValue()), area(feature.get("geometry")), properties);
    }

    private static ObjectNode area(JsonNode geometry) throws UnreadableException {
        if (geometry == null) {
            throw refused("the field has no member 'geometry'; null says that the field ends");
        }
        if (geometry.isNull()) {
            return null;
        }
        if (!AREAS.contains(geometry.path("type").asText())) {
            throw refused("'geometry' of the field is neither a Polygon nor a MultiPolygon");
        }
        return (ObjectNode) geometry;
    }

    /** A time as {@code validFrom} and keys have it, ISO 8601 with an offset, in epoch ms. */
    private static long time(String iso) throws UnreadableException {
        try {
            return Instant.parse(iso).toEpochMilli();
        } catch (DateTimeException | ArithmeticException e) {
            throw new UnreadableException(
                    Reason.NOT_AN_EVENT, "'" + iso + "' is not a time; write for instance 2026-03-01T00:00:00.000Z", e);
        }
    }

    /** The record's key: {@code <id>@<validFrom>}, the time in UTC with milliseconds. */
    public String key() {
        return new Key(id, validFrom).toString();
    }

    /** Whether the field ends here. */
    public boolean isEnd() {
        return geometry == null;
    }

    /** What people call the field; empty if it has no name. */
    public String name() {
        return properties.path("name").asText("");
    }

    /** The domain that the field belongs to; empty if it belongs to none. */
    public String domain() {
        return properties.path("Domain").asText("");
    }

    /** Whether its property {@code kind} is {@code exclusion}: an area in which devices may be close to each other. */
    public boolean isExclusion() {
        return properties.path("kind").asText("").equals("exclusion");
    }

    /** UTF-8 JSON of the Feature. */
    public byte[] toBytes() {
        ObjectNode feature = none().put("type", "Feature").put("id", id);
        feature.set("geometry", geometry);
        ObjectNode all = none().put(VALID_FROM, iso(validFrom));
        feature.set("properties", all.setAll(properties));
        return NgsiJson.write(feature);
    }

    private static String iso(long time) {
        return UTC_MILLIS.format(Instant.ofEpochMilli(time));
    }

    private static ObjectNode none() {
        return NgsiJson.object();
    }

    private static UnreadableException refused(String why) {
        return new UnreadableException(Reason.NOT_AN_EVENT, why);
    }
}
