package io.furrow.model.position;

import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.FirosJson;
import io.furrow.model.ngsi.Numbers;
import io.furrow.model.ngsi.UnreadableException;

/** Parses each form of a position for {@link PositionReading}. */
final class PositionParser {
    /** Pairs of attributes that are a position, in the order of precedence. */
    static final List<Pair> PAIRS = List.of(new Pair("Latitude", "Longitude"), new Pair("latitude", "longitude"));

    static final PositionReading NO_POINT = new PositionReading.Faulty("location is not a GeoJSON Point");

    /** The names of two attributes. */
    public record Pair(String latitude, String longitude) {}

    private PositionParser() {}

    /** Checks a position in degrees; NaN if the entity has no number. */
    static PositionReading of(double latitude, double longitude) {
        if (Double.isNaN(latitude) || Double.isNaN(longitude)) {
            return new PositionReading.Faulty("latitude or longitude is not a number");
        }
        if (Math.abs(latitude) > 90 || Math.abs(longitude) > 180) {
            return new PositionReading.Faulty("latitude or longitude is out of range");
        }
        return latitude == 0 && longitude == 0
                ? new PositionReading.Faulty("0,0 is what a receiver without a fix reports")
                : new PositionReading.Located(new Position(latitude, longitude));
    }

    /** Parses the value of {@code location}. */
    static PositionReading ofLocation(JsonNode location) {
        if (location.isTextual()) {
            return ofGeoPoint(location.textValue());
        }
        JsonNode coordinates = location.path("coordinates");
        boolean pair = coordinates.isArray() && coordinates.size() >= 2;
        return "Point".equals(location.path("type").textValue()) && pair
                ? of(number(coordinates.get(1)), number(coordinates.get(0)))
                : NO_POINT;
    }

    /** Parses a geo:point, {@code "lat, lon"}. */
    static PositionReading ofGeoPoint(String text) {
        String[] parts = text.split(",", -1);
        return parts.length == 2
                ? of(Numbers.finite(parts[0]), Numbers.finite(parts[1]))
                : new PositionReading.Faulty("geo:point is not 'lat, lon'");
    }

    /** Parses the text of {@code gnss} or {@code pose}. */
    static PositionReading ofFiros(String escaped) {
        try {
            JsonNode message = FirosJson.read(escaped);
            return of(number(message.path("latitude")), number(message.path("longitude")));
        } catch (UnreadableException e) {
            return new PositionReading.Faulty("gnss or pose is not JSON: " + e.getMessage());
        }
    }

    private static double number(JsonNode node) {
        return Numbers.finite(node).orElse(Double.NaN);
    }
}
