package io.furrow.analytics.field;

import java.nio.file.Path;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvFileSource;

import io.furrow.model.field.FieldVersion;
import io.furrow.model.position.Position;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

class FieldIndexTest {
    private static final Path FIELDS = Path.of("src/test/resources/field/fields.geojson");

    @ParameterizedTest(name = "{0}")
    @CsvFileSource(resources = "/field/covered-positions.csv", numLinesToSkip = 1)
    void findsEveryFieldThatCoversAPosition(String what, double latitude, double longitude, String fields)
            throws Exception {
        FieldVersions known = FieldVersions.read(new InitialFields(GeoJsonFieldFile.read(FIELDS)));

        assertThat(known.covering(new Position(latitude, longitude), 1))
                .extracting(Field::id)
                .containsExactlyInAnyOrder(fields == null ? new String[0] : fields.split(" "));
    }

    @Test
    void keepsTheDomainOfAField() throws Exception {
        assertThat(GeoJsonFieldFile.read(FIELDS))
                .extracting(FieldVersion::id, FieldVersion::domain)
                .contains(tuple("north", "canary"), tuple("ring", ""));
    }
}
