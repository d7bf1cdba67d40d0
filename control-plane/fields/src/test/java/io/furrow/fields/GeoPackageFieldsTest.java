package io.furrow.fields;

import java.nio.file.Files;
import java.nio.file.Path;
import java.sql.Connection;
import java.sql.DriverManager;
import java.sql.Statement;
import java.time.Duration;

import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.model.field.InvalidFileException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** A layer may be a view. */
@Timeout(value = 60, threadMode = Timeout.ThreadMode.SEPARATE_THREAD)
class GeoPackageFieldsTest {
    private static final String NUMBERS =
            "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT i AS fid, ";
    private static final GeoPackageFields.Limits UNLIMITED =
            new GeoPackageFields.Limits(Duration.ofHours(1), Integer.MAX_VALUE, Long.MAX_VALUE);

    @TempDir
    private Path folder;

    private Path file;

    @BeforeEach
    void copy() throws Exception {
        file = Files.copy(FieldFilesTest.resource("geopackage-25830.gpkg"), folder.resolve("views.gpkg"));
    }

    @Test
    void readsAView() throws Exception {
        addView("SELECT * FROM fields");

        assertThat(GeoPackageFields.read(file, "v").features()).hasSize(2).allMatch(field -> field.outline() != null);
    }

    /** No row ever comes, or one after the other. */
    @Test
    void endsAViewThatNeverEndsAtTheTimeout() throws Exception {
        GeoPackageFields.Limits limits =
                new GeoPackageFields.Limits(Duration.ofMillis(200), Integer.MAX_VALUE, Long.MAX_VALUE);
        for (String end : new String[] {"NULL AS geom FROM n WHERE i < 0", "NULL AS geom FROM n"}) {
            addView(NUMBERS + end);
            assertThatThrownBy(() -> GeoPackageFields.read(file, "v", limits))
                    .isInstanceOf(InvalidFileException.class)
                    .hasMessageContainingAll(
                            "views.gpkg: the layer 'v' takes longer than", "save its fields as a table");
        }
    }

    @Test
    void rejectsTooManyFeatures() throws Exception {
        addView(NUMBERS + "NULL AS geom FROM n LIMIT 3000");
        assertThatThrownBy(() -> GeoPackageFields.read(
                        file, "v", new GeoPackageFields.Limits(Duration.ofHours(1), 1000, Long.MAX_VALUE)))
                .isInstanceOf(InvalidFileException.class)
                .hasMessageContaining("the layer 'v' has more than 1,000 features");
    }

    @Test
    void rejectsTooManyBytes() throws Exception {
        GeoPackageFields.Limits limits = new GeoPackageFields.Limits(Duration.ofHours(1), Integer.MAX_VALUE, 1 << 20);
        for (String large : new String[] {
            "zeroblob(1000) AS geom FROM n LIMIT 3000",
            "NULL AS geom, hex(zeroblob(500)) FROM n LIMIT 3000",
            "NULL AS geom, i AS a, i AS b, i AS c, i AS d FROM n LIMIT 3000"
        }) {
            addView(NUMBERS + large);
            assertThatThrownBy(() -> GeoPackageFields.read(file, "v", limits))
                    .isInstanceOf(InvalidFileException.class)
                    .hasMessageContaining("the layer 'v' has more than 1 MiB");
        }
    }

    @Test
    void rejectsALargeValue() throws Exception {
        addView("SELECT 1 AS fid, zeroblob(20000000) AS geom");
        assertThatThrownBy(() -> GeoPackageFields.read(file, "v", UNLIMITED))
                .isInstanceOf(InvalidFileException.class)
                .hasMessageContaining("is not a readable GeoPackage (String or BLOB exceeds size limit");
    }

    private void addView(String query) throws Exception {
        try (Connection database = DriverManager.getConnection("jdbc:sqlite:" + file);
                Statement statement = database.createStatement()) {
            statement.execute("DROP VIEW IF EXISTS v");
            statement.execute("CREATE VIEW v AS " + query);
            for (String table : new String[] {"gpkg_contents", "gpkg_geometry_columns"}) {
                statement.execute("DELETE FROM " + table + " WHERE table_name = 'v'");
            }
            statement.execute("INSERT INTO gpkg_contents (table_name, data_type, identifier, srs_id)"
                    + " SELECT 'v', data_type, 'v', srs_id FROM gpkg_contents WHERE table_name = 'fields'");
            statement.execute(
                    "INSERT INTO gpkg_geometry_columns SELECT 'v', column_name, geometry_type_name, srs_id, z, m"
                            + " FROM gpkg_geometry_columns WHERE table_name = 'fields'");
        }
    }
}
