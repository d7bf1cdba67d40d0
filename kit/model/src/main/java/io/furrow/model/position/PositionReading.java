package io.furrow.model.position;

import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.function.Supplier;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;

/**
 * The result of reading an entity's position: {@code location} (geo:json Point in lon/lat order, or geo:point text
 * "lat, lon"), else {@code Latitude} and {@code Longitude}, else {@code latitude} and {@code longitude}, else FIROS'
 * {@code gnss} or {@code pose} text (JSON with quotes escaped as {@code %27}). The first of these that is present and
 * not blank counts. The dashboard's page follows the same rules, and its tests use the same table of cases. Values out
 * of range, other than numbers, or exactly 0,0 are not positions.
 */
public sealed interface PositionReading {
    /** The attributes that may contain a position. */
    Set<String> ATTRIBUTES = Set.of("location", "Latitude", "Longitude", "latitude", "longitude", "gnss", "pose");

    /** A usable position. */
    record Located(Position position) implements PositionReading {}

    /** The entity has no position. */
    record Absent() implements PositionReading {}

    /** The entity has an invalid position; {@code fault} says why. */
    record Faulty(String fault) implements PositionReading {}

    /** Reads the position of an event with these headers; absent if a part of the position is later than the event. */
    static PositionReading of(Map<String, String> headers, Supplier<PositionReading> reading) {
        String later = headers.get(HeaderNames.LATER_ATTRIBUTES);
        boolean isLater = later != null && Stream.of(later.split(",")).anyMatch(ATTRIBUTES::contains);
        return isLater ? new Absent() : reading.get();
    }

    static PositionReading of(Entity entity) {
        Optional<JsonNode> location = entity.value("location")
                .filter(value -> !value.isTextual() || !value.textValue().isBlank());
        if (location.isPresent()) {
            return PositionParser.ofLocation(location.get());
        }
        for (PositionParser.Pair names : PositionParser.PAIRS) {
            if (entity.value(names.latitude()).isPresent()
                    || entity.value(names.longitude()).isPresent()) {
                return PositionParser.of(
                        entity.number(names.latitude()).orElse(Double.NaN),
                        entity.number(names.longitude()).orElse(Double.NaN));
            }
        }
        Optional<String> firos = entity.text("gnss").or(() -> entity.text("pose"));
        return firos.map(PositionParser::ofFiros).orElseGet(Absent::new);
    }

    /** Returns the position if it is usable. */
    default Optional<Position> usable() {
        return this instanceof Located located ? Optional.of(located.position()) : Optional.empty();
    }
}
