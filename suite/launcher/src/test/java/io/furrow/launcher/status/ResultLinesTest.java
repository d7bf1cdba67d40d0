package io.furrow.launcher.status;

import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.Entity;

import static org.assertj.core.api.Assertions.assertThat;

class ResultLinesTest {
    @Test
    void reportsAnAverageWithItsSuspect() {
        Entity average = Entity.builder("Analytics:FieldTemperature:f", "Analytics:FieldTemperature")
                .text("field", "f")
                .number("averageTemperature", 21.256)
                .integer("devices", 4)
                .texts("suspects", List.of("t4"))
                .text("quality", "robust")
                .integer("windowEnd", 0)
                .build();

        assertThat(ResultLines.average(average))
                .matches("f +21\\.26 °C   4 devices, robust, suspect t4   window to \\d\\d:00:00");
    }

    @Test
    void reportsAnEncounter() {
        Entity collision = Entity.builder("c", "Analytics:Collision")
                .text("phase", "started")
                .number("distance", 4.5)
                .integer("time", 0)
                .text("Device1_ID", "a")
                .text("Device2_ID", "b")
                .build();

        assertThat(ResultLines.collision(collision)).matches("\\d\\d:00:00 started   4\\.50 m   a – b");
    }
}
