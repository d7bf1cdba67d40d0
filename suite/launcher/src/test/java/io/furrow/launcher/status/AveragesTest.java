package io.furrow.launcher.status;

import org.junit.jupiter.api.Test;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;

import static org.assertj.core.api.Assertions.assertThat;

class AveragesTest {
    private static final FiwareScope OTHER = new FiwareScope("other", "/north");

    private final Averages averages = new Averages();

    @Test
    void retainsTheNewestAverageOfEachScopeOfAField() {
        String alone = averages.put(average(20), OTHER);
        assertThat(alone).startsWith("f  ").contains("20.00").doesNotContain("other");
        assertThat(averages.lines()).containsExactly(alone);

        averages.put(average(30), FiwareScope.DEFAULT);
        String newest = averages.put(average(21), OTHER);

        assertThat(newest).contains("21.00").endsWith(" of other /north");
        assertThat(averages.lines())
                .satisfiesExactly(
                        line -> assertThat(line).contains("30.00").endsWith(" of /"),
                        line -> assertThat(line).isEqualTo(newest));
    }

    private static Entity average(double value) {
        return Entity.builder("Analytics:FieldTemperature:f", "Analytics:FieldTemperature")
                .text("field", "f")
                .number("averageTemperature", value)
                .build();
    }
}
