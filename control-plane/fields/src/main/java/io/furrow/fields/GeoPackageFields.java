package io.furrow.fields;

import java.nio.file.Path;
import java.sql.Connection;
import java.sql.DriverManager;
import java.sql.PreparedStatement;
import java.sql.ResultSet;
import java.sql.SQLException;
import java.sql.Statement;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.field.InvalidFileException;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.FailureText;

/** Reads a feature layer of a GeoPackage (OGC 12-128), an SQLite database. The order is x, y in every coordinate system. */
record GeoPackageFields(Path file, Connection database) {
    private static final String LAYERS = """
        SELECT c.table_name, g.column_name, g.srs_id, s.organization, s.organization_coordsys_id, s.definition
        FROM gpkg_contents c JOIN gpkg_geometry_columns g ON g.table_name = c.table_name
        LEFT JOIN gpkg_spatial_ref_sys s ON s.srs_id = g.srs_id
        WHERE c.data_type = 'features' ORDER BY c.table_name\
        """;

    private record Layer(String table, String geometry, String crs) {}

    /** @param name name of the layer; null for the only one */
    static FieldLayer read(Path file, String name) throws InvalidFileException {
        String url =
                "jdbc:sqlite:file:" + file.toUri().getRawPath() + (hasLog(file) ? "?mode=ro" : "?mode=ro&immutable=1");
        try (Connection database = DriverManager.getConnection(url)) {
            return new GeoPackageFields(file, database).layer(name);
        } catch (SQLException e) {
            throw new InvalidFileException(
                    file + " is not a readable GeoPackage (" + FailureText.of(e).replaceFirst("^\\[\\w+] *", "") + ")",
                    e);
        }
    }

    /** Whether a write-ahead log holds changes that are not in the file yet, as while QGIS has it open. */
    private static boolean hasLog(Path file) {
        return file.resolveSibling(file.getFileName() + "-wal").toFile().length() > 0;
    }

    private FieldLayer layer(String name) throws SQLException, InvalidFileException {
        List<Layer> layers = layers();
        List<String> names = layers.stream().map(Layer::table).toList();
        List<Layer> chosen = layers.stream()
                .filter(layer -> name == null || layer.table().equals(name))
                .toList();
        if (chosen.size() != 1) {
            throw new InvalidFileException("%s contains the layers %s; choose one with --layer".formatted(file, names));
        }
        return new FieldLayer(chosen.get(0).crs(), features(chosen.get(0)), List.of());
    }

    private List<Layer> layers() throws SQLException {
        List<Layer> layers = new ArrayList<>();
        try (Statement statement = database.createStatement();
                ResultSet row = statement.executeQuery(LAYERS)) {
            while (row.next()) {
                layers.add(new Layer(row.getString(1), row.getString(2), crs(row)));
            }
        }
        return layers;
    }

    /** Returns the EPSG code, else the definition; null for the "undefined" systems −1 and 0. */
    private static String crs(ResultSet row) throws SQLException {
        if (row.getInt("srs_id") <= 0) {
            return null;
        }
        return "EPSG".equalsIgnoreCase(row.getString("organization"))
                ? "EPSG:" + row.getInt("organization_coordsys_id")
                : row.getString("definition");
    }

    private List<SourceFeature> features(Layer layer) throws SQLException {
        List<SourceFeature> features = new ArrayList<>();
        String key = primaryKey(layer.table());
        String query = "SELECT * FROM " + quoted(layer.table()) + (key == null ? "" : " ORDER BY " + quoted(key));
        try (PreparedStatement statement = database.prepareStatement(query);
                ResultSet row = statement.executeQuery()) {
            while (row.next()) {
                features.add(feature(features.size() + 1, row, layer, key));
            }
        }
        return features;
    }

    private static SourceFeature feature(int number, ResultSet row, Layer layer, String key) throws SQLException {
        ObjectNode properties = NgsiJson.object();
        for (int column = 1; column <= row.getMetaData().getColumnCount(); column++) {
            String name = row.getMetaData().getColumnName(column);
            if (!name.equals(layer.geometry()) && !name.equals(key)) {
                put(properties, name, row.getObject(column));
            }
        }
        // The column 'id' takes precedence over the primary key.
        String id = key == null || properties.has("id") ? null : row.getString(key);
        try {
            return new SourceFeature(
                    number, id, properties, GeoPackageGeometry.outline(row.getBytes(layer.geometry())), null);
        } catch (RejectedFeatureException e) {
            return new SourceFeature(number, id, properties, null, e.getMessage());
        }
    }

    private static void put(ObjectNode properties, String name, Object value) {
        if (value instanceof Integer || value instanceof Long) {
            properties.put(name, ((Number) value).longValue());
        } else if (value instanceof Number number) {
            properties.put(name, number.doubleValue());
        } else if (value != null && !(value instanceof byte[])) {
            properties.put(name, value.toString());
        }
    }

    private String primaryKey(String table) throws SQLException {
        try (ResultSet keys = database.getMetaData().getPrimaryKeys(null, null, table)) {
            return keys.next() ? keys.getString("COLUMN_NAME") : null;
        }
    }

    private static String quoted(String name) {
        return '"' + name.replace("\"", "\"\"") + '"';
    }
}
