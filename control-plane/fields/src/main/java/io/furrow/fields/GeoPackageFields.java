package io.furrow.fields;

import java.nio.file.Path;
import java.sql.Connection;
import java.sql.DriverManager;
import java.sql.PreparedStatement;
import java.sql.ResultSet;
import java.sql.SQLException;
import java.sql.Statement;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.node.ObjectNode;
import org.sqlite.ProgressHandler;
import org.sqlite.SQLiteConnection;
import org.sqlite.SQLiteErrorCode;
import org.sqlite.SQLiteLimits;

import io.furrow.model.field.InvalidFileException;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.FailureText;

/**
 * Reads a feature layer of a GeoPackage (OGC 12-128), an SQLite database. The order is x, y in every coordinate system.
 * A layer may be a view, which may be endless or many times larger than the file: time and size are limited.
 */
final class GeoPackageFields {
    private static final Limits LIMITS = new Limits(Duration.ofSeconds(10), 100_000, 64 << 20);
    /** More than the outline of any field. */
    private static final int MAX_VALUE_BYTES = 16 << 20;
    /** Of a property in memory, beside its text. */
    private static final int PROPERTY_BYTES = 100;
    /** Number of instructions of SQLite between two looks at the clock, less than a millisecond. */
    private static final int INSTRUCTIONS = 10_000;

    private static final int INTERRUPTED = SQLiteErrorCode.SQLITE_INTERRUPT.code;
    private static final String LAYERS = """
        SELECT c.table_name, g.column_name, g.srs_id, s.organization, s.organization_coordsys_id, s.definition
        FROM gpkg_contents c JOIN gpkg_geometry_columns g ON g.table_name = c.table_name
        LEFT JOIN gpkg_spatial_ref_sys s ON s.srs_id = g.srs_id
        WHERE c.data_type = 'features' ORDER BY c.table_name LIMIT 1000\
        """;

    private final Path file;
    private final Connection database;
    private final Limits limits;
    private long bytes;

    /** @param bytes of all values of a layer; in memory, an outline takes three times its bytes */
    record Limits(Duration timeout, int features, long bytes) {}

    private record Layer(String table, String geometry, String crs) {}

    private GeoPackageFields(Path file, Connection database, Limits limits) {
        this.file = file;
        this.database = database;
        this.limits = limits;
    }

    /** @param name name of the layer; null for the only one */
    static FieldLayer read(Path file, String name) throws InvalidFileException {
        return read(file, name, LIMITS);
    }

    static FieldLayer read(Path file, String name, Limits limits) throws InvalidFileException {
        String url =
                "jdbc:sqlite:file:" + file.toUri().getRawPath() + (hasLog(file) ? "?mode=ro" : "?mode=ro&immutable=1");
        try (Connection database = DriverManager.getConnection(url)) {
            limit(database, limits.timeout());
            return new GeoPackageFields(file, database, limits).layer(name);
        } catch (SQLException e) {
            if (e.getErrorCode() == INTERRUPTED) {
                throw tooLarge(
                        file,
                        name,
                        "takes longer than %d s to read"
                                .formatted(limits.timeout().toSeconds()),
                        e);
            }
            throw new InvalidFileException(
                    file + " is not a readable GeoPackage (" + FailureText.of(e).replaceFirst("^\\[\\w+] *", "") + ")",
                    e);
        }
    }

    private static void limit(Connection database, Duration timeout) throws SQLException {
        database.unwrap(SQLiteConnection.class).setLimit(SQLiteLimits.SQLITE_LIMIT_LENGTH, MAX_VALUE_BYTES);
        long deadline = System.nanoTime() + timeout.toNanos();
        ProgressHandler.setHandler(database, INSTRUCTIONS, new ProgressHandler() {
            @Override
            protected int progress() {
                return System.nanoTime() - deadline < 0 ? 0 : 1;
            }
        });
    }

    private static InvalidFileException tooLarge(Path file, String layer, String why, SQLException cause) {
        return new InvalidFileException(
                "%s: %s %s; if it is a view, save its fields as a table, else split it into several files"
                        .formatted(file, layer == null ? "its layer" : "the layer '" + layer + "'", why),
                cause);
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

    private List<SourceFeature> features(Layer layer) throws SQLException, InvalidFileException {
        List<SourceFeature> features = new ArrayList<>();
        String key = primaryKey(layer.table());
        String query = "SELECT * FROM " + quoted(layer.table()) + (key == null ? "" : " ORDER BY " + quoted(key));
        try (PreparedStatement statement = database.prepareStatement(query);
                ResultSet row = statement.executeQuery()) {
            while (row.next()) {
                features.add(feature(features.size() + 1, row, layer, key));
                if (features.size() > limits.features()) {
                    throw tooLarge(
                            file, layer.table(), "has more than %,d features".formatted(limits.features()), null);
                }
                if (bytes > limits.bytes()) {
                    throw tooLarge(file, layer.table(), "has more than %d MiB".formatted(limits.bytes() >> 20), null);
                }
            }
        }
        return features;
    }

    private SourceFeature feature(int number, ResultSet row, Layer layer, String key) throws SQLException {
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
            byte[] geometry = row.getBytes(layer.geometry());
            bytes += geometry == null ? 0 : geometry.length;
            return new SourceFeature(number, id, properties, GeoPackageGeometry.outline(geometry), null);
        } catch (RejectedFeatureException e) {
            return new SourceFeature(number, id, properties, null, e.getMessage());
        }
    }

    private void put(ObjectNode properties, String name, Object value) {
        bytes += PROPERTY_BYTES;
        if (value instanceof Integer || value instanceof Long) {
            properties.put(name, ((Number) value).longValue());
        } else if (value instanceof Number number) {
            properties.put(name, number.doubleValue());
        } else if (value != null && !(value instanceof byte[])) {
            String text = value.toString();
            bytes += text.length();
            properties.put(name, text);
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
