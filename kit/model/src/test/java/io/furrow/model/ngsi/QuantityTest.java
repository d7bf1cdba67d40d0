package io.furrow.model.ngsi;

import java.util.Set;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvFileSource;

import io.furrow.model.position.EntityReader;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

/** The tests of the dashboard's page use the same table. */
class QuantityTest {
    @ParameterizedTest
    @CsvFileSource(resources = "quantities.csv", delimiter = '|', quoteCharacter = '\u0001')
    void followsTheCaseTable(Quantity quantity, String attribute, String outcome) throws Exception {
        byte[] entity = ("{\"id\":\"a\",\"x\":" + attribute + "}").getBytes(UTF_8);
        double expected = outcome.equals("none") ? Double.NaN : Double.parseDouble(outcome);
        EntityReader reader = new EntityReader(Set.of("x"));

        reader.read(entity);

        assertThat(reader.number("x", quantity)).isEqualTo(expected, within(1e-9));
        assertThat(quantity.of(Entity.parse(entity), "x").orElse(Double.NaN)).isEqualTo(expected, within(1e-9));
    }
}
