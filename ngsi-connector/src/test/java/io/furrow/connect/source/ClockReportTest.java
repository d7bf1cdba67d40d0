package io.furrow.connect.source;

import java.time.Duration;
import java.time.Instant;

import org.junit.jupiter.api.Test;

import io.furrow.model.event.EntityEvent;
import io.furrow.model.event.EventTimeRule;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;

import static org.assertj.core.api.Assertions.assertThat;

class ClockReportTest {
    private static final Instant NOW = Instant.parse("2026-11-21T02:00:00Z");

    @Test
    void namesADeviceOnceUntilItIsForgotten() {
        ClockReport report = new ClockReport(2);

        assertThat(report.note(event("a", 600))).isTrue();
        assertThat(report.note(event("a", 600))).isFalse();
        assertThat(report.note(event("b", 600))).isTrue();
        assertThat(report.note(event("c", 600))).isTrue();
        assertThat(report.note(event("a", 600))).as("only two are remembered").isTrue();
    }

    @Test
    void saysNothingOfAClockThatIsRight() {
        assertThat(new ClockReport(2).note(event("a", 10))).isFalse();
    }

    private static EntityEvent event(String id, long secondsAhead) {
        Entity entity = Entity.builder(id, "T")
                .integer("Time", NOW.plusSeconds(secondsAhead).toEpochMilli())
                .build();
        return EntityEvent.of(
                entity, FiwareScope.DEFAULT, NOW, EventTimeRule.within(Duration.ofMinutes(5)), Origin.NOTIFICATION);
    }
}
