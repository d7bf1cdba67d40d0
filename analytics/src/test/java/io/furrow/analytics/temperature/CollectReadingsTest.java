package io.furrow.analytics.temperature;

import java.util.Random;

import org.apache.flink.api.common.serialization.SerializerConfigImpl;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeutils.TypeSerializer;
import org.apache.flink.core.memory.DataOutputSerializer;
import org.junit.jupiter.api.Test;

import io.furrow.model.position.Position;

import static org.assertj.core.api.Assertions.assertThat;

class CollectReadingsTest {
    private final CollectReadings collect = new CollectReadings();

    @Test
    void hasTheMedianOfAllValuesInAnyOrder() {
        Random random = new Random(15);
        for (int count = 1; count <= 200; count++) {
            double[] values = random.doubles(count, -5, 5)
                    .map(value -> Math.round(value * 2) / 2.0)
                    .toArray();
            DeviceReadings readings = collect.createAccumulator();
            for (double value : values) {
                readings = collect.add(reading(value), readings);
            }

            assertThat(collect.getResult(readings).median()).isEqualTo(Median.of(values));
        }
    }

    @Test
    void doesNotGrowWithReadingsThatRepeatAValue() throws Exception {
        DeviceReadings readings = collect.createAccumulator();
        for (int second = 0; second < 86_400; second++) {
            readings = collect.add(reading(18 + second / 60 % 50 / 10.0), readings);
        }

        assertThat(readings.values()).hasSize(50);
        assertThat(readings.times().stream().mapToInt(Integer::intValue).sum()).isEqualTo(86_400);
        DataOutputSerializer out = new DataOutputSerializer(1024);
        serializer().serialize(readings, out);
        assertThat(out.length()).isLessThan(1_000);
    }

    private static TypeSerializer<DeviceReadings> serializer() {
        return TypeInformation.of(DeviceReadings.class).createSerializer(new SerializerConfigImpl());
    }

    private static FieldReading reading(double value) {
        return new FieldReading(
                "north",
                "canary",
                7,
                new Reading(
                        "t1",
                        "Thermometer",
                        Farm.SCOPE,
                        new Position(52, 12),
                        value,
                        "id",
                        Farm.north("t1", value, 0)));
    }
}
