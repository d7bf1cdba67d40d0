package io.furrow.model.position;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvFileSource;

import io.furrow.model.ngsi.Notification;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class PositionReadingTest {
    @ParameterizedTest
    @CsvFileSource(resources = "positions.csv", delimiter = '|', quoteCharacter = '\u0001')
    void followsTheCaseTable(String attributes, String outcome, String detail) throws Exception {
        byte[] body = ("{\"id\":\"a\"," + attributes + "}").getBytes(UTF_8);

        PositionReading reading = PositionReading.of(
                Notification.read(body, "simplifiedKeyValues").entities().get(0));

        switch (outcome) {
            case "absent" -> assertThat(reading).isInstanceOf(PositionReading.Absent.class);
            case "fault" ->
                assertThat(reading)
                        .isInstanceOfSatisfying(
                                PositionReading.Faulty.class,
                                faulty -> assertThat(faulty.fault()).contains(detail));
            default ->
                assertThat(reading.usable())
                        .contains(new Position(Double.parseDouble(outcome), Double.parseDouble(detail)));
        }
        assertThat(reading.usable().isPresent()).isEqualTo(reading instanceof PositionReading.Located);
    }
}
