package io.furrow.analytics.temperature;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvFileSource;

import io.furrow.model.ngsi.Position;

import static org.assertj.core.api.Assertions.assertThat;

class FieldIndexTest {
    @ParameterizedTest(name = "{0}")
    @CsvFileSource(resources = "/temperature/covered-positions.csv", numLinesToSkip = 1)
    void findsEveryFieldThatCoversAPosition(String what, double latitude, double longitude, String fields)
            throws Exception {
        FieldIndex index = new FieldIndex(FieldFile.read(Farm.FIELDS));

        assertThat(index.covering(new Position(latitude, longitude)))
                .extracting(Field::id)
                .containsExactlyInAnyOrder(fields == null ? new String[0] : fields.split(" "));
    }

    @Test
    void keepsTheDomainOfAField() throws Exception {
        assertThat(FieldFile.read(Farm.FIELDS))
                .extracting(Field::id, Field::domain)
                .contains(
                        org.assertj.core.groups.Tuple.tuple("north", "canary"),
                        org.assertj.core.groups.Tuple.tuple("ring", ""));
    }
}
