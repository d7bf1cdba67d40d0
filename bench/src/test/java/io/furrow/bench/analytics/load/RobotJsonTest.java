package io.furrow.bench.analytics.load;

import org.apache.kafka.clients.producer.ProducerRecord;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.analytics.position.PositionFix;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.position.PositionReading;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class RobotJsonTest {
    private static final double HALF_OF_THE_LAST_DECIMAL = 0.5e-7;

    @ParameterizedTest
    @CsvSource({"40.3125,-3.4821", "-0.00000004,7", "-89.99999999,-179.9999999", "9.00000012,100.5"})
    void isAnEntityAtThePlaceOfTheFix(double latitude, double longitude) throws Exception {
        PositionFix fix = Fleet.fix("farm|/|robot-1", "robot-1", latitude, longitude, 0);

        var entity = Entity.parse(RobotJson.record("t", fix, 1_700_000_000_123L).value());

        assertThat(entity.id()).isEqualTo("robot-1");
        assertThat(entity.number("Time")).contains(1_700_000_000_123.0);
        PositionReading.Located located = (PositionReading.Located) PositionReading.of(entity);
        assertThat(located.position().latitude()).isCloseTo(latitude, within(HALF_OF_THE_LAST_DECIMAL));
        assertThat(located.position().longitude()).isCloseTo(longitude, within(HALF_OF_THE_LAST_DECIMAL));
    }

    @Test
    void staysAnEntityWithNotes() throws Exception {
        PositionFix fix = Fleet.fix("farm|/|robot-1", "robot-1", 1, 2, 0);

        ProducerRecord<byte[], byte[]> record = RobotJson.padded("t", 1, fix, 1_700_000_000_123L, 20);

        assertThat(record.partition()).isEqualTo(1);
        assertThat(Entity.parse(record.value()).text("Notes")).contains("x".repeat(20));
        assertThat(RobotJson.padded("t", 0, fix, 1_700_000_000_123L, 0).value())
                .isEqualTo(RobotJson.record("t", fix, 1_700_000_000_123L).value());
    }
}
