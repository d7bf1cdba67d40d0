package io.furrow.model.field;

import java.nio.charset.StandardCharsets;

import com.fasterxml.jackson.databind.JsonNode;
import org.locationtech.jts.geom.Envelope;
import org.locationtech.jts.geom.Geometry;
import org.locationtech.jts.io.ParseException;
import org.locationtech.jts.io.geojson.GeoJsonReader;
import org.locationtech.jts.operation.valid.IsValidOp;
import org.locationtech.jts.operation.valid.TopologyValidationError;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Reads the area of a field or another place from GeoJSON and rejects areas with an ambiguous interior. All areas are
 * read by it except those of files, which are repaired. Requires JTS on the class path of callers.
 */
public final class FieldArea {
    private static final Envelope EARTH = new Envelope(-180, 180, -90, 90);

    private FieldArea() {}

    /**
     * @param field name of the area in the message
     * @throws UnreadableException with {@link Reason#NOT_AN_EVENT}; the message names the place and the remedy
     */
    public static Geometry read(JsonNode geometry, String field) throws UnreadableException {
        if (!FieldVersion.AREAS.contains(geometry.path("type").asText())) {
            throw rejected(field + " is not an area; give it a geometry of type Polygon or MultiPolygon", null);
        }
        int depth = geometry.path("type").asText().equals("Polygon") ? 2 : 3;
        Geometry area;
        try {
            if (!hasCorners(geometry.path("coordinates"), depth)) {
                throw new ParseException("a corner is no [longitude, latitude]");
            }
            area = new GeoJsonReader().read(new String(NgsiJson.write(geometry), StandardCharsets.UTF_8));
        } catch (ParseException | NumberFormatException e) {
            throw rejected(
                    field
                            + " has broken coordinates; a ring is four or more [longitude, latitude], the last like"
                            + " the first",
                    e);
        }
        if (area.isEmpty()) {
            throw rejected(field + " has no coordinates; draw its border or take it out", null);
        }
        if (!EARTH.contains(area.getEnvelopeInternal())) {
            throw rejected(field + " lies outside of longitude ±180, latitude ±90; give degrees in WGS 84", null);
        }
        TopologyValidationError error = new IsValidOp(area).getValidationError();
        if (error != null) {
            throw rejected(
                    field + " is not a valid area: " + error.getMessage() + " at longitude " + error.getCoordinate().x
                            + ", latitude " + error.getCoordinate().y + "; redraw its border there",
                    null);
        }
        return area;
    }

    /** Returns whether each corner at this depth of lists has two numbers; JTS reads a missing one as zero. */
    private static boolean hasCorners(JsonNode coordinates, int depth) {
        if (depth == 0) {
            return coordinates.path(0).isNumber() && coordinates.path(1).isNumber();
        }
        for (JsonNode each : coordinates) {
            if (!hasCorners(each, depth - 1)) {
                return false;
            }
        }
        return coordinates.isArray();
    }

    private static UnreadableException rejected(String what, Throwable cause) {
        return new UnreadableException(Reason.NOT_AN_EVENT, what, cause);
    }
}
