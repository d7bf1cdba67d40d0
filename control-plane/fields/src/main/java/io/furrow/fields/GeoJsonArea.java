package io.furrow.fields;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.locationtech.jts.algorithm.Orientation;
import org.locationtech.jts.geom.CoordinateSequence;
import org.locationtech.jts.geom.Geometry;
import org.locationtech.jts.geom.LineString;
import org.locationtech.jts.geom.Polygon;

/** Writes an area as GeoJSON with the orientation of RFC 7946: shells counter-clockwise, holes clockwise. */
final class GeoJsonArea {
    private GeoJsonArea() {}

    static ObjectNode of(Geometry area) {
        ObjectNode geometry = JsonNodeFactory.instance.objectNode();
        if (area instanceof Polygon polygon) {
            geometry.put("type", "Polygon").set("coordinates", polygon(polygon));
        } else {
            ArrayNode polygons = geometry.put("type", "MultiPolygon").putArray("coordinates");
            for (int part = 0; part < area.getNumGeometries(); part++) {
                polygons.add(polygon((Polygon) area.getGeometryN(part)));
            }
        }
        return geometry;
    }

    private static ArrayNode polygon(Polygon polygon) {
        ArrayNode rings = JsonNodeFactory.instance.arrayNode().add(ring(polygon.getExteriorRing(), true));
        for (int hole = 0; hole < polygon.getNumInteriorRing(); hole++) {
            rings.add(ring(polygon.getInteriorRingN(hole), false));
        }
        return rings;
    }

    private static ArrayNode ring(LineString ring, boolean counterClockwise) {
        CoordinateSequence corners = ring.getCoordinateSequence();
        boolean reversed = Orientation.isCCWArea(ring.getCoordinates()) != counterClockwise;
        ArrayNode positions = JsonNodeFactory.instance.arrayNode(corners.size());
        for (int index = 0; index < corners.size(); index++) {
            int corner = reversed ? corners.size() - 1 - index : index;
            positions.addArray().add(corners.getX(corner)).add(corners.getY(corner));
        }
        return positions;
    }
}
