package io.furrow.fields;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.sql.Connection;
import java.sql.DriverManager;
import java.sql.Statement;
import java.time.Instant;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.field.FieldFile;
import io.furrow.model.field.ImportOptions;
import io.furrow.model.field.ImportedField;
import io.furrow.model.field.InvalidFileException;
import io.furrow.model.field.RejectedFeature;
import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

/** Compares positions with those of GDAL, which created the files, see {@code make.sh} next to them. */
public class FieldFilesTest {
    public static final ImportOptions PLAIN = new ImportOptions(null, null, null, null, null, Instant.EPOCH);
    private static final double METERS_PER_DEGREE = 111_195;

    @TempDir
    private Path folder;

    /** For ED50 (EPSG:23030) PROJ uses other parameters, which differ by meters; without any the error would be 150 m. */
    @ParameterizedTest
    @CsvSource({
        "shapefile-25830.shp,    farm.geojson,    0.01",
        "geopackage-25830.gpkg,  farm.geojson,    0.01",
        "geojson-25830.geojson,  farm.geojson,    0.01",
        "shapefile-3857.shp,     farm.geojson,    0.01",
        "geopackage-3857.gpkg,   farm.geojson,    0.01",
        "geojson-3857.geojson,   farm.geojson,    0.01",
        "shapefile-3035.shp,     farm.geojson,    0.01",
        "geopackage-3035.gpkg,   farm.geojson,    0.01",
        "geojson-3035.geojson,   farm.geojson,    0.01",
        "shapefile-4326.shp,     farm.geojson,    0",
        "geopackage-4326.gpkg,   farm.geojson,    0",
        "farm.geojson,           farm.geojson,    0",
        "shapefile-25831.shp,    farm-31.geojson, 0.01",
        "geopackage-25831.gpkg,  farm-31.geojson, 0.01",
        "shapefile-2393.shp,     farm-fi.geojson, 0.01",
        "geopackage-2393.gpkg,   farm-fi.geojson, 0.01",
        "shapefile-23030.shp,    farm.geojson,    15",
        "geopackage-23030.gpkg,  farm.geojson,    15",
        "geojson-23030.geojson,  farm.geojson,    15",
    })
    void locatesFieldsAsGdalDoes(String file, String expected, double meters) throws Exception {
        FieldFile read = FieldFiles.read(resource(file), named("code"));

        assertThat(read.refused()).isEmpty();
        assertThat(read.fields()).extracting(field -> field.version().id()).containsExactly("north-1", "south-2");
        JsonNode features =
                NgsiJson.read(Files.readAllBytes(resource(expected))).path("features");
        for (int index = 0; index < features.size(); index++) {
            List<double[]> corners = corners(read.fields().get(index).version().geometry());
            List<double[]> reference = corners((ObjectNode) features.get(index).path("geometry"));
            assertThat(corners).hasSameSizeAs(reference);
            for (double[] corner : corners) {
                assertThat(reference.stream()
                                .mapToDouble(one -> distance(one, corner))
                                .min()
                                .orElseThrow())
                        .isLessThanOrEqualTo(meters + 1e-8);
            }
        }
    }

    /** By pyproj 3.4.1: Geod(ellps="WGS84").polygon_area_perimeter of the rings. */
    @Test
    void computesTheAreaOnTheEllipsoid() throws Exception {
        FieldFile read = FieldFiles.read(resource("shapefile-25830.shp"), named("code"));

        assertThat(read.fields().get(0).hectares()).isCloseTo(4.908080321, within(1e-4));
        assertThat(read.fields().get(1).hectares()).isCloseTo(1.604647905, within(1e-4));
        assertThat(read.fields().get(0).edgeErrorMeters()).isBetween(1e-6, 0.01);
        assertThat(read.accuracyMeters()).isEqualTo(1);
    }

    @ParameterizedTest
    @CsvSource({"shapefile-25830.shp", "shapefile-4326.shp", "geopackage-25830.gpkg", "farm.geojson"})
    void readsNamesAndAttributes(String file) throws Exception {
        ImportOptions options = new ImportOptions(null, null, "code", null, null, Instant.ofEpochMilli(7));
        FieldFile read = FieldFiles.read(resource(file), options);

        ImportedField north = read.fields().get(0);
        assertThat(north.version().key()).isEqualTo("north-1@1970-01-01T00:00:00.007Z");
        assertThat(north.version().name()).isEqualTo("La Poveda ñ");
        assertThat(north.version().domain()).isEqualTo("arganda");
        assertThat(north.version().properties().path("height").asDouble()).isEqualTo(530.5);
        assertThat(north.version().properties().path("crop").asText()).isEqualTo("maize");

        ImportOptions chosen = new ImportOptions(null, null, "code", "crop", "other", Instant.EPOCH);
        ImportedField renamed = FieldFiles.read(resource(file), chosen).fields().get(0);
        assertThat(renamed.version().name()).isEqualTo("maize");
        assertThat(renamed.version().domain()).isEqualTo("other");
    }

    @Test
    void reportsThatHeightsAreLeftOut() throws Exception {
        FieldFile read = FieldFiles.read(resource("shapefile-heights.shp"), named("code"));

        assertThat(read.fields()).allSatisfy(field -> assertThat(field.notes()).containsExactly("left out heights"));
    }

    @Test
    void choosesALayer() throws Exception {
        Path file = resource("geopackage-layers.gpkg");

        assertUnusable(file, PLAIN, "[fields, more]", "--layer");
        FieldFile more = FieldFiles.read(file, new ImportOptions("more", null, "code", null, null, Instant.EPOCH));
        assertThat(more.crs()).contains("UTM zone 30N");
        assertThat(more.fields()).hasSize(2);
    }

    @Test
    void usesTheGivenCoordinateSystemIfTheFileNamesNone() throws Exception {
        Path shp = Files.copy(resource("shapefile-25830.shp"), folder.resolve("bare.SHP"));
        Files.copy(resource("shapefile-25830.dbf"), folder.resolve("bare.DBF"));

        assertUnusable(shp, named("code"), "--crs EPSG:25830");
        for (String crs :
                List.of("EPSG:25830", "urn:ogc:def:crs:EPSG::25830", "http://www.opengis.net/def/crs/EPSG/0/25830")) {
            ImportOptions options = new ImportOptions(null, crs, "code", null, null, Instant.EPOCH);
            assertThat(FieldFiles.read(shp, options).fields()).hasSize(2);
        }
        ImportOptions wrong = new ImportOptions(null, "EPSG:99999", "code", null, null, Instant.EPOCH);
        assertUnusable(shp, wrong, "'EPSG:99999' is not a known coordinate system");
    }

    @Test
    void explainsHowToConvertAFeaturePerLine() throws Exception {
        Path file = Files.writeString(folder.resolve("x.geojsonl"), "{\"type\":\"Feature\"}\n{\"type\":\"Feature\"}\n");

        assertThatThrownBy(() -> FieldFiles.read(file, PLAIN))
                .isInstanceOf(InvalidFileException.class)
                .hasMessageEndingWith(
                        "is not JSON (more than one JSON document at line 2, column 1); put the features into one FeatureCollection");
    }

    /** Well-known text may define the northing first, but files have the easting first. */
    @Test
    void readsEastingFirstWhateverTheTextDefines() throws Exception {
        Path shp = copy("north");
        String prj = Files.readString(resource("shapefile-25830.prj"));
        Files.writeString(
                folder.resolve("north.prj"),
                prj.replaceFirst("]\\s*$", ",AXIS[\"Northing\",NORTH],AXIS[\"Easting\",EAST]]"));

        FieldFile read = FieldFiles.read(shp, named("code"));

        double[] corner = corners(read.fields().get(0).version().geometry()).get(0);
        assertThat(distance(corner, new double[] {-3.4840, 40.3130})).isLessThan(400);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
        PROJCS["x",GEOGCS["g",DATUM["D_Nowhere",SPHEROID["s",6377000,300]],PRIMEM["Greenwich",0],UNIT["Degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["Central_Meridian",-3],UNIT["Meter",1]]
        LOCAL_CS["somewhere"]
        VERT_CS["sea level",VERT_DATUM["sea level",2005],UNIT["Meter",1]]
        EPSG:4978
        nonsense
        """)
    void rejectsACoordinateSystemWithoutTransformation(String prj) throws Exception {
        Path shp = copy("lost");
        Files.writeString(folder.resolve("lost.prj"), prj);

        assertUnusable(shp, named("code"), "is not a known coordinate system", "--crs");
    }

    @Test
    void readsUncheckpointedChangesOfAnOpenGeoPackage() throws Exception {
        Path file = Files.copy(resource("geopackage-25830.gpkg"), folder.resolve("open.gpkg"));
        try (Connection qgis = DriverManager.getConnection("jdbc:sqlite:" + file);
                Statement statement = qgis.createStatement()) {
            statement.execute("PRAGMA journal_mode=WAL");
            statement.execute("UPDATE fields SET name = 'changed'");

            assertThat(FieldFiles.read(file, PLAIN).fields())
                    .allSatisfy(field -> assertThat(field.version().name()).isEqualTo("changed"));
        }
    }

    @Test
    void readsGeoJsonWithAByteOrderMark() throws Exception {
        Path file = Files.writeString(
                folder.resolve("marked.geojson"), "\ufeff" + Files.readString(resource("farm.geojson")));

        assertThat(FieldFiles.read(file, PLAIN).fields()).isNotEmpty();
    }

    @Test
    void explainsWhyAFileIsRejected() throws Exception {
        assertUnusable("x", "neither GeoJSON nor a Shapefile");
        assertUnusable("{", "is not JSON");
        assertUnusable("{\"type\": \"Topology\"}", "not a GeoJSON FeatureCollection");
        assertUnusable(folder.resolve("missing"), PLAIN, "cannot be read");
        assertUnusable(
                resource("farm.geojson"),
                named("cod"),
                "--id-property cod: no feature of",
                "[Domain, code, crop, height, name]");
        byte[] shp = Files.readAllBytes(resource("shapefile-25830.shp"));
        Path broken = Files.write(folder.resolve("broken.shp"), Arrays.copyOf(shp, shp.length - 40));
        assertUnusable(broken, PLAIN, "is truncated in record 2");
        Path gpkg = Files.write(
                folder.resolve("broken.gpkg"),
                Arrays.copyOf(Files.readAllBytes(resource("geopackage-25830.gpkg")), 3000));
        assertUnusable(gpkg, PLAIN, "is not a readable GeoPackage");
    }

    @Test
    void explainsWhatIsDamagedInAShapefile() throws Exception {
        Path shp = copy("damaged");
        ImportOptions options = new ImportOptions(null, "EPSG:25830", "code", null, null, Instant.EPOCH);
        overwrite(shp, 156, 0xff, 0xff, 0xff, 0x7f); // the start of the second ring

        assertThat(FieldFiles.read(shp, options).refused())
                .singleElement()
                .extracting(RejectedFeature::reason)
                .isEqualTo("has rings whose start indices are not in order");

        overwrite(folder.resolve("damaged.dbf"), 49, 0xff); // the length of a column
        assertUnusable(shp, options, "damaged.dbf cannot be read");
    }

    private static void overwrite(Path file, int at, int... bytes) throws IOException {
        byte[] content = Files.readAllBytes(file);
        for (int i = 0; i < bytes.length; i++) {
            content[at + i] = (byte) bytes[i];
        }
        Files.write(file, content);
    }

    private void assertUnusable(String content, String message) throws IOException {
        assertUnusable(Files.writeString(folder.resolve("file"), content, UTF_8), PLAIN, message);
    }

    static void assertUnusable(Path file, ImportOptions options, String... message) {
        assertThatThrownBy(() -> FieldFiles.read(file, options))
                .isInstanceOf(InvalidFileException.class)
                .hasMessageContainingAll(message);
    }

    /** The Shapefile without a coordinate system. */
    private Path copy(String name) throws IOException {
        Files.copy(resource("shapefile-25830.dbf"), folder.resolve(name + ".dbf"));
        return Files.copy(resource("shapefile-25830.shp"), folder.resolve(name + ".shp"));
    }

    static ImportOptions named(String property) {
        return new ImportOptions(null, null, property, null, null, Instant.EPOCH);
    }

    static Path resource(String name) {
        return Path.of(FieldFilesTest.class.getResource(name).getPath());
    }

    private static double distance(double[] one, double[] other) {
        return METERS_PER_DEGREE
                * Math.hypot((one[0] - other[0]) * Math.cos(Math.toRadians(one[1])), one[1] - other[1]);
    }

    public static List<double[]> corners(ObjectNode geometry) {
        List<double[]> corners = new ArrayList<>();
        collect(geometry.path("coordinates"), corners);
        return corners;
    }

    private static void collect(JsonNode node, List<double[]> corners) {
        if (node.path(0).isNumber()) {
            corners.add(new double[] {node.get(0).asDouble(), node.get(1).asDouble()});
        } else {
            node.forEach(one -> collect(one, corners));
        }
    }
}
