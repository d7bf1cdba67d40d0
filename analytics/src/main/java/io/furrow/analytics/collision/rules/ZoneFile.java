package io.furrow.analytics.collision.rules;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import org.locationtech.jts.geom.Geometry;

import io.furrow.model.field.FieldArea;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Reads exclusion zones from a GeoJSON FeatureCollection (RFC 7946) of Polygons and MultiPolygons in degrees. A zone that
 * crosses the antimeridian is cut there into a MultiPolygon, as the RFC demands.
 */
public final class ZoneFile {
    private ZoneFile() {}

    /** @throws IllegalArgumentException if a single feature is invalid: a zone that is silently missing would be worse */
    public static ExclusionZones read(Path file) {
        JsonNode features = json(file).path("features");
        if (!features.isArray() || features.isEmpty()) {
            throw refused(file, "holds no feature; give a GeoJSON FeatureCollection with one feature per zone", null);
        }
        List<Geometry> areas = new ArrayList<>();
        for (JsonNode feature : features) {
            areas.add(area(file, feature.path("geometry"), "feature " + (areas.size() + 1)));
        }
        return new ExclusionZones(areas);
    }

    private static JsonNode json(Path file) {
        try {
            return NgsiJson.read(Files.readAllBytes(file));
        } catch (IOException e) {
            throw refused(file, "cannot be read; name a readable GeoJSON file", e);
        } catch (UnreadableException e) {
            throw refused(file, "is not JSON (" + e.getMessage() + "); give a GeoJSON FeatureCollection", e);
        }
    }

    private static Geometry area(Path file, JsonNode geometry, String name) {
        try {
            return FieldArea.read(geometry, name);
        } catch (UnreadableException e) {
            throw refused(file, e.getMessage(), e);
        }
    }

    private static IllegalArgumentException refused(Path file, String what, Throwable cause) {
        return new IllegalArgumentException("--zones " + file + ": " + what, cause);
    }
}
