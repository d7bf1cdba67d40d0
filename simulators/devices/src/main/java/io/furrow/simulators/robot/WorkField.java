package io.furrow.simulators.robot;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.locationtech.jts.geom.Coordinate;
import org.locationtech.jts.geom.GeometryFactory;
import org.locationtech.jts.geom.LinearRing;
import org.locationtech.jts.geom.Polygon;
import org.locationtech.jts.operation.valid.IsValidOp;

import io.furrow.model.position.Position;

/**
 * A field in meters of a plane.
 *
 * @param area one polygon, may have holes
 */
public record WorkField(String id, LocalPlane plane, Polygon area) {
    static final GeometryFactory GEOMETRIES = new GeometryFactory();

    /**
     * Reads a GeoJSON Feature (RFC 7946) with {@code id} and a Polygon.
     *
     * @throws IllegalArgumentException naming the mistake and the remedy
     */
    public static WorkField of(JsonNode feature) {
        String id = feature.path("id").asText();
        if (!feature.path("type").asText().equals("Feature") || id.isBlank()) {
            throw new IllegalArgumentException("a field is a GeoJSON Feature with an id");
        }
        JsonNode geometry = feature.path("geometry");
        if (!geometry.path("type").asText().equals("Polygon")) {
            throw new IllegalArgumentException(
                    "the geometry of field '%s' is not a Polygon: make each part of a MultiPolygon a field of its own"
                            .formatted(id));
        }
        List<List<Position>> rings = new ArrayList<>();
        for (JsonNode ring : geometry.path("coordinates")) {
            rings.add(ring(id, ring));
        }
        if (rings.isEmpty()) {
            throw new IllegalArgumentException("the Polygon of field '%s' has no ring".formatted(id));
        }
        LocalPlane plane = new LocalPlane(rings.get(0).get(0));
        List<LinearRing> closed =
                rings.stream().map(ring -> inMeters(plane, ring)).toList();
        Polygon area = GEOMETRIES.createPolygon(
                closed.get(0), closed.subList(1, closed.size()).toArray(LinearRing[]::new));
        IsValidOp validity = new IsValidOp(area);
        if (!validity.isValid()) {
            Position at = plane.toPosition(validity.getValidationError().getCoordinate());
            throw new IllegalArgumentException("the Polygon of field '%s' is not valid at %f, %f: %s"
                    .formatted(
                            id,
                            at.latitude(),
                            at.longitude(),
                            validity.getValidationError().getMessage()));
        }
        return new WorkField(id, plane, area);
    }

    /**
     * Creates a field from a Polygon, or from the largest part of a MultiPolygon.
     *
     * @throws IllegalArgumentException as {@link #of}
     */
    public static WorkField largestOf(String id, JsonNode geometry) {
        boolean many = geometry.path("type").asText().equals("MultiPolygon");
        List<WorkField> parts = new ArrayList<>();
        for (JsonNode part : many ? geometry.path("coordinates") : List.of(geometry.path("coordinates"))) {
            ObjectNode feature = JsonNodeFactory.instance.objectNode();
            feature.put("type", "Feature").put("id", id);
            feature.putObject("geometry").put("type", "Polygon").set("coordinates", part);
            parts.add(of(feature));
        }
        return parts.stream()
                .max(Comparator.comparingDouble(part -> part.area().getArea()))
                .orElseThrow(() -> new IllegalArgumentException("field '%s' has no part".formatted(id)));
    }

    public boolean covers(Coordinate meters) {
        return area.covers(GEOMETRIES.createPoint(meters));
    }

    private static List<Position> ring(String id, JsonNode ring) {
        List<Position> corners = new ArrayList<>();
        for (JsonNode corner : ring) {
            if (!corner.path(0).isNumber() || !corner.path(1).isNumber()) {
                throw new IllegalArgumentException(
                        "a corner of field '%s' is no [longitude, latitude]: %s".formatted(id, corner));
            }
            corners.add(
                    new Position(corner.path(1).doubleValue(), corner.path(0).doubleValue()));
        }
        if (corners.size() < 4 || !corners.get(0).equals(corners.get(corners.size() - 1))) {
            throw new IllegalArgumentException(
                    "a ring of field '%s' is not closed: its last corner is its first, with at least two between"
                            .formatted(id));
        }
        return corners;
    }

    private static LinearRing inMeters(LocalPlane plane, List<Position> ring) {
        return GEOMETRIES.createLinearRing(ring.stream().map(plane::toMeters).toArray(Coordinate[]::new));
    }
}
