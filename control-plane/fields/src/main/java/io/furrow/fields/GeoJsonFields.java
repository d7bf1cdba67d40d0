package io.furrow.fields;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.locationtech.jts.geom.Coordinate;

import io.furrow.model.field.InvalidFileException;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.Counts;

/**
 * Reads GeoJSON (RFC 7946), with the member {@code crs} of its predecessor of 2008. The order is x, y in every
 * coordinate system, as both specify.
 */
final class GeoJsonFields {
    private static final String WGS84 = "CRS84";
    /** Editors on Windows write it at the start of UTF-8 files. */
    private static final byte[] BYTE_ORDER_MARK = {(byte) 0xef, (byte) 0xbb, (byte) 0xbf};

    private GeoJsonFields() {}

    static FieldLayer read(Path file) throws InvalidFileException {
        JsonNode json = json(file);
        List<JsonNode> features = new ArrayList<>();
        switch (json.path("type").asText()) {
            case "FeatureCollection" -> json.path("features").forEach(features::add);
            case "Feature" -> features.add(json);
            default ->
                throw new InvalidFileException(
                        file + " is JSON, but not a GeoJSON FeatureCollection or Feature; write one feature per field");
        }
        List<SourceFeature> read = new ArrayList<>();
        for (JsonNode feature : features) {
            read.add(feature(read.size() + 1, feature));
        }
        return new FieldLayer(crs(file, json), read, List.of());
    }

    /** Returns the index after the byte order mark, if there is one. */
    static int begin(byte[] file) {
        return Arrays.mismatch(BYTE_ORDER_MARK, file) == BYTE_ORDER_MARK.length ? BYTE_ORDER_MARK.length : 0;
    }

    private static JsonNode json(Path file) throws InvalidFileException {
        try {
            return NgsiJson.readFile(Files.readAllBytes(file));
        } catch (IOException e) {
            throw new InvalidFileException(file, e);
        } catch (UnreadableException e) {
            String remedy =
                    e.getMessage().startsWith("more than one") ? "; put the features into one FeatureCollection" : "";
            throw new InvalidFileException(file + " is not JSON (" + e.getMessage() + ")" + remedy, e);
        }
    }

    private static String crs(Path file, JsonNode json) throws InvalidFileException {
        JsonNode crs = json.path("crs");
        if (crs.isMissingNode()) {
            return WGS84;
        }
        if (crs.path("type").asText().equals("name")) {
            return crs.path("properties").path("name").asText();
        }
        if (crs.path("type").asText().equals("EPSG")) {
            return "EPSG:" + crs.path("properties").path("code").asText();
        }
        throw new InvalidFileException(file
                + " has a member 'crs' that does not name a coordinate system; specify it with --crs, or remove"
                + " the member");
    }

    private static SourceFeature feature(int number, JsonNode feature) {
        JsonNode member = feature.path("id");
        String id = member.isTextual() || member.isIntegralNumber() ? member.asText() : null;
        ObjectNode properties =
                feature.path("properties") instanceof ObjectNode some ? some.deepCopy() : NgsiJson.object();
        try {
            return new SourceFeature(number, id, properties, outline(feature.path("geometry")), null);
        } catch (RejectedFeatureException e) {
            return new SourceFeature(number, id, properties, null, e.getMessage());
        }
    }

    private static Outline outline(JsonNode geometry) throws RejectedFeatureException {
        List<List<List<Coordinate>>> polygons = new ArrayList<>();
        List<String> notes = new ArrayList<>();
        collect(geometry, polygons, notes);
        int reversed = Rings.countReversed(polygons, true);
        if (reversed > 0) {
            notes.add("reversed " + Counts.of(reversed, "ring") + " to the orientation of RFC 7946");
        }
        return new Outline(polygons, notes);
    }

    private static void collect(JsonNode geometry, List<List<List<Coordinate>>> polygons, List<String> notes)
            throws RejectedFeatureException {
        JsonNode coordinates = geometry.path("coordinates");
        switch (geometry.path("type").asText()) {
            case "Polygon" -> polygons.add(polygon(coordinates));
            case "MultiPolygon" -> {
                for (JsonNode polygon : coordinates) {
                    polygons.add(polygon(polygon));
                }
            }
            case "GeometryCollection" -> {
                for (JsonNode part : geometry.path("geometries")) {
                    if (part.path("type").asText().matches("(Multi)?(Point|LineString)")) {
                        notes.add("left out a " + part.path("type").asText() + " next to the area");
                    } else {
                        collect(part, polygons, notes);
                    }
                }
            }
            case "" -> throw new RejectedFeatureException("has no geometry");
            default ->
                throw new RejectedFeatureException(
                        "is a " + geometry.path("type").asText() + "; a field is a Polygon or MultiPolygon");
        }
    }

    private static List<List<Coordinate>> polygon(JsonNode rings) throws RejectedFeatureException {
        List<List<Coordinate>> polygon = new ArrayList<>();
        for (JsonNode ring : rings) {
            List<Coordinate> corners = new ArrayList<>();
            for (JsonNode corner : ring) {
                if (!corner.isArray()
                        || !corner.path(0).isNumber()
                        || !corner.path(1).isNumber()) {
                    throw new RejectedFeatureException("has a corner that is not [x, y]: " + Phrases.shortened(corner));
                }
                double z = corner.path(2).isNumber() ? corner.path(2).doubleValue() : Double.NaN;
                corners.add(new Coordinate(
                        corner.get(0).doubleValue(), corner.get(1).doubleValue(), z));
            }
            polygon.add(corners);
        }
        return polygon;
    }
}
