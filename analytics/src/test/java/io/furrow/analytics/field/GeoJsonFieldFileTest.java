package io.furrow.analytics.field;

import java.nio.file.Files;
import java.nio.file.Path;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvFileSource;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class GeoJsonFieldFileTest {
    private static final String SQUARE = """
        {"type": "Feature", "id": "square",
         "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]]}}\
        """;

    @TempDir
    private Path dir;

    @ParameterizedTest(name = "{0}")
    @CsvFileSource(resources = "/field/unusable-fields.csv", delimiter = ';', numLinesToSkip = 1, quoteCharacter = '`')
    void refusesAFeatureAndSaysWhichAndWhy(String what, String feature, String reason) throws Exception {
        assertThat(GeoJsonFieldFile.read(file(SQUARE))).hasSize(1);
        Path file = file(SQUARE + "," + feature);

        assertThatThrownBy(() -> GeoJsonFieldFile.read(file))
                .isInstanceOf(InvalidFieldsException.class)
                .hasMessageStartingWith("--fields " + file + ": feature 2")
                .hasMessageContaining(reason);
    }

    @Test
    void refusesAFileThatCannotBeRead() {
        Path missing = dir.resolve("missing.geojson");

        assertThatThrownBy(() -> GeoJsonFieldFile.read(missing))
                .isInstanceOf(InvalidFieldsException.class)
                .hasMessage("--fields " + missing + ": cannot be read; name a readable GeoJSON file")
                .hasCauseInstanceOf(java.nio.file.NoSuchFileException.class);
    }

    @Test
    void refusesAFileWithoutFeatures() throws Exception {
        Path file = file("");

        assertThatThrownBy(() -> GeoJsonFieldFile.read(file))
                .isInstanceOf(InvalidFieldsException.class)
                .hasMessageContaining("holds no feature");
    }

    @Test
    void refusesAFileThatIsNoJson() throws Exception {
        Path file = Files.writeString(dir.resolve("fields.geojson"), "lon,lat");

        assertThatThrownBy(() -> GeoJsonFieldFile.read(file))
                .isInstanceOf(InvalidFieldsException.class)
                .hasMessageContaining("is not JSON");
    }

    private Path file(String features) throws Exception {
        return Files.writeString(
                dir.resolve("fields.geojson"), "{\"type\": \"FeatureCollection\", \"features\": [" + features + "]}");
    }
}
