package io.furrow.model.ngsi;

import java.nio.charset.StandardCharsets;
import java.util.Optional;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * The position of an entity: {@code location} (geo:json Point in lon/lat order, or geo:point text "lat, lon"), else
 * {@code Latitude} and {@code Longitude}, else FIROS' {@code gnss} or {@code pose} text (JSON with quotes escaped as
 * {@code %27}). The first of these that is present decides. Out of range, not a number, or exactly 0,0 is no position.
 */
public sealed interface PositionReading {
    /** The attributes that can tell a position. */
    Set<String> ATTRIBUTES = Set.of("location", "Latitude", "Longitude", "gnss", "pose");

    /** A position that can be used. */
    record Located(Position position) implements PositionReading {}

    /** The entity says nothing of its position. */
    record Absent() implements PositionReading {}

    /** The entity has a position that cannot be right; {@code fault} says why. */
    record Faulty(String fault) implements PositionReading {}

    static PositionReading of(Entity entity) {
        Optional<JsonNode> location = entity.value("location");
        if (location.isPresent()) {
            return fromLocation(location.get());
        }
        if (entity.value("Latitude").isPresent() || entity.value("Longitude").isPresent()) {
            return checked(entity.number("Latitude"), entity.number("Longitude"));
        }
        Optional<String> firos = entity.text("gnss").or(() -> entity.text("pose"));
        return firos.map(PositionReading::fromFiros).orElseGet(Absent::new);
    }

    /** The position, if there is one that can be used. */
    default Optional<Position> usable() {
        return this instanceof Located located ? Optional.of(located.position()) : Optional.empty();
    }

    private static PositionReading fromLocation(JsonNode location) {
        if (location.isTextual()) {
            String[] parts = location.textValue().split(",", -1);
            return parts.length == 2
                    ? checked(finite(parts[0]), finite(parts[1]))
                    : new Faulty("geo:point is not 'lat, lon'");
        }
        JsonNode coordinates = location.path("coordinates");
        boolean pair = coordinates.isArray() && coordinates.size() >= 2;
        if (!"Point".equals(location.path("type").textValue()) || !pair) {
            return new Faulty("location is no GeoJSON Point");
        }
        return checked(Numbers.finite(coordinates.get(1)), Numbers.finite(coordinates.get(0)));
    }

    private static PositionReading fromFiros(String escaped) {
        try {
            byte[] json = escaped.replace("%27", "\"").getBytes(StandardCharsets.UTF_8);
            JsonNode message = NgsiJson.read(json);
            return checked(Numbers.finite(message.path("latitude")), Numbers.finite(message.path("longitude")));
        } catch (UnreadableException e) {
            return new Faulty("gnss or pose is no JSON: " + e.getMessage());
        }
    }

    private static Optional<Double> finite(String text) {
        return Numbers.finite(com.fasterxml.jackson.databind.node.TextNode.valueOf(text));
    }

    private static PositionReading checked(Optional<Double> latitude, Optional<Double> longitude) {
        if (latitude.isEmpty() || longitude.isEmpty()) {
            return new Faulty("latitude or longitude is no number");
        }
        double lat = latitude.get();
        double lon = longitude.get();
        if (Math.abs(lat) > 90 || Math.abs(lon) > 180) {
            return new Faulty("latitude or longitude is out of range");
        }
        return lat == 0 && lon == 0 ? new Faulty("0,0 is what a receiver without a fix reports") : located(lat, lon);
    }

    private static PositionReading located(double latitude, double longitude) {
        return new Located(new Position(latitude, longitude));
    }
}
