package io.furrow.analytics.field;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.field.FieldArea;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Reads fields from a GeoJSON FeatureCollection (RFC 7946) of Polygons and MultiPolygons. A field's id is the feature's
 * {@code id}, else its property {@code id}; its domain is the property {@code Domain}, its name the property {@code name}. It
 * is valid from 1970 on, forever. A field that crosses the antimeridian is cut there into a MultiPolygon, as the RFC demands.
 */
final class GeoJsonFieldFile {
    private final Path file;
    private final Map<String, FieldVersion> fields = new LinkedHashMap<>();

    private GeoJsonFieldFile(Path file) {
        this.file = file;
    }

    /** @throws InvalidFieldsException if a single feature is invalid: a field that is silently missing would be worse */
    static List<FieldVersion> read(Path file) throws InvalidFieldsException {
        GeoJsonFieldFile reader = new GeoJsonFieldFile(file);
        JsonNode features = reader.json().path("features");
        if (!features.isArray() || features.isEmpty()) {
            throw reader.refused("holds no feature; give a GeoJSON FeatureCollection with one feature per field", null);
        }
        for (int number = 1; number <= features.size(); number++) {
            reader.add(features.get(number - 1), number);
        }
        return List.copyOf(reader.fields.values());
    }

    private JsonNode json() throws InvalidFieldsException {
        try {
            return NgsiJson.read(Files.readAllBytes(file));
        } catch (IOException e) {
            throw refused("cannot be read; name a readable GeoJSON file", e);
        } catch (UnreadableException e) {
            throw refused("is not JSON (" + e.getMessage() + "); give a GeoJSON FeatureCollection", e);
        }
    }

    private void add(JsonNode feature, int number) throws InvalidFieldsException {
        JsonNode properties = feature.path("properties");
        JsonNode idNode = feature.hasNonNull("id") ? feature.get("id") : properties.path("id");
        String id = idNode.isIntegralNumber() || idNode.isTextual() ? idNode.asText() : "";
        if (id.isEmpty()) {
            throw refused("feature " + number + " has no id; give it a member \"id\" that no other has", null);
        }
        String name = "feature " + number + " (id " + id + ")";
        if (!FieldVersion.isId(id)) {
            throw refused(
                    name + " has an id that the context broker refuses; use at most 200 of A-Z a-z 0-9 _ - : .", null);
        }
        try {
            FieldArea.read(feature.path("geometry"), name);
        } catch (UnreadableException e) {
            throw refused(e.getMessage(), e);
        }
        ObjectNode said = properties.isObject() ? properties.deepCopy() : JsonNodeFactory.instance.objectNode();
        FieldVersion field = new FieldVersion(id, 0, (ObjectNode) feature.get("geometry"), said);
        if (fields.put(id, field) != null) {
            throw refused(name + " has the id of an earlier feature; give each field its own", null);
        }
    }

    private InvalidFieldsException refused(String what, Throwable cause) {
        return new InvalidFieldsException("--fields " + file + ": " + what, cause);
    }
}
