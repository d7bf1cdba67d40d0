package io.furrow.connect.source;

import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;

import org.apache.logging.log4j.Level;
import org.apache.logging.log4j.LogManager;
import org.apache.logging.log4j.core.LogEvent;
import org.apache.logging.log4j.core.Logger;
import org.apache.logging.log4j.core.appender.AbstractAppender;
import org.apache.logging.log4j.core.config.Configurator;
import org.apache.logging.log4j.core.config.Property;
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

    @Test
    void writesOneLineWhateverTheIdHolds() {
        List<String> messages = new ArrayList<>();
        Logger logger = (Logger) LogManager.getLogger(ClockReport.class);
        AbstractAppender recorder = new AbstractAppender("recorder", null, null, true, Property.EMPTY_ARRAY) {
            @Override
            public void append(LogEvent event) {
                messages.add(event.getMessage().getFormattedMessage());
            }
        };
        recorder.start();
        logger.addAppender(recorder);
        Level usual = logger.getLevel();
        Configurator.setLevel(logger, Level.WARN);
        try {
            new ClockReport(2).note(event("a\nERROR all is lost", 600));
        } finally {
            logger.removeAppender(recorder);
            Configurator.setLevel(logger, usual);
        }

        assertThat(messages)
                .singleElement()
                .satisfies(message -> assertThat(message)
                        .contains("a\\u000aERROR all is lost")
                        .doesNotContain("\n"));
    }

    private static EntityEvent event(String id, long secondsAhead) {
        Entity entity = Entity.builder(id, "T")
                .integer("Time", NOW.plusSeconds(secondsAhead).toEpochMilli())
                .build();
        return EntityEvent.of(
                entity, FiwareScope.DEFAULT, NOW, EventTimeRule.within(Duration.ofMinutes(5)), Origin.NOTIFICATION);
    }
}
