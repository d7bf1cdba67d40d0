package io.furrow.analytics.temperature;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import org.locationtech.jts.geom.Envelope;
import org.locationtech.jts.geom.Geometry;
import org.locationtech.jts.io.ParseException;
import org.locationtech.jts.io.geojson.GeoJsonReader;
import org.locationtech.jts.operation.valid.IsValidOp;
import org.locationtech.jts.operation.valid.TopologyValidationError;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Fields from a GeoJSON FeatureCollection (RFC 7946) of Polygons and MultiPolygons. A field's id is the feature's {@code id},
 * else its property {@code id}; its domain is the property {@code Domain}. A field that crosses the antimeridian is cut there
 * into a MultiPolygon, as the RFC asks.
 */
final class FieldFile {
    private static final Set<String> AREAS = Set.of("Polygon", "MultiPolygon");
    private static final Envelope EARTH = new Envelope(-180, 180, -90, 90);
    /** What may stand in an entity id (NGSI-v2, "Field syntax restrictions"), with room for the prefix of the result's. */
    private static final Pattern ID = Pattern.compile("[!-~&&[^&?/#<>\"'=;()]]{1,200}");

    private final Path file;
    private final Map<String, Field> fields = new LinkedHashMap<>();

    private FieldFile(Path file) {
        this.file = file;
    }

    /**
     * @throws UnusableFieldsException if a single feature cannot be used: a field that is silently missing would be worse
     */
    static List<Field> read(Path file) throws UnusableFieldsException {
        FieldFile reader = new FieldFile(file);
        JsonNode features = reader.json().path("features");
        if (!features.isArray() || features.isEmpty()) {
            throw reader.refused("holds no feature; give a GeoJSON FeatureCollection with one feature per field", null);
        }
        for (int number = 1; number <= features.size(); number++) {
            reader.add(features.get(number - 1), number);
        }
        return List.copyOf(reader.fields.values());
    }

    private JsonNode json() throws UnusableFieldsException {
        try {
            return NgsiJson.read(Files.readAllBytes(file));
        } catch (IOException e) {
            throw refused("cannot be read; name a readable GeoJSON file", e);
        } catch (UnreadableException e) {
            throw refused("is no JSON (" + e.getMessage() + "); give a GeoJSON FeatureCollection", e);
        }
    }

    private void add(JsonNode feature, int number) throws UnusableFieldsException {
        JsonNode properties = feature.path("properties");
        JsonNode idNode = feature.hasNonNull("id") ? feature.get("id") : properties.path("id");
        String id = idNode.isIntegralNumber() || idNode.isTextual() ? idNode.asText() : "";
        if (id.isEmpty()) {
            throw refused("feature " + number + " has no id; give it a member \"id\" that no other has", null);
        }
        String name = "feature " + number + " (id " + id + ")";
        if (!ID.matcher(id).matches()) {
            throw refused(
                    name + " has an id that the context broker refuses; use at most 200 of A-Z a-z 0-9 _ - : .", null);
        }
        Geometry area = area(feature.path("geometry"), name);
        Field field = new Field(id, properties.path("Domain").asText(""), area);
        if (fields.put(id, field) != null) {
            throw refused(name + " has the id of an earlier feature; give each field its own", null);
        }
    }

    private Geometry area(JsonNode geometry, String name) throws UnusableFieldsException {
        if (!AREAS.contains(geometry.path("type").asText())) {
            throw refused(name + " is no area; give it a geometry of type Polygon or MultiPolygon", null);
        }
        Geometry area;
        try {
            area = new GeoJsonReader().read(new String(NgsiJson.write(geometry), StandardCharsets.UTF_8));
        } catch (ParseException | NumberFormatException e) {
            throw refused(
                    name
                            + " has broken coordinates; a ring is four or more [longitude, latitude], the last like the first",
                    e);
        }
        if (area.isEmpty()) {
            throw refused(name + " has no coordinates; draw its border or take it out", null);
        }
        if (!EARTH.contains(area.getEnvelopeInternal())) {
            throw refused(name + " lies outside of longitude ±180, latitude ±90; give degrees in WGS 84", null);
        }
        TopologyValidationError error = new IsValidOp(area).getValidationError();
        if (error != null) {
            throw refused(
                    name + " is no valid area: " + error.getMessage() + " at longitude " + error.getCoordinate().x
                            + ", latitude " + error.getCoordinate().y + "; redraw its border there",
                    null);
        }
        return area;
    }

    private UnusableFieldsException refused(String what, Throwable cause) {
        return new UnusableFieldsException("--fields " + file + ": " + what, cause);
    }
}
