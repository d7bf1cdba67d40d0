package io.furrow.connect.source.notification;

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

import io.furrow.model.event.EventTime;
import io.furrow.model.event.FiwareScope;

import static org.assertj.core.api.Assertions.assertThat;

class ClockWarningTest {
    @Test
    void namesADeviceOnceUntilItIsForgotten() {
        ClockWarning report = new ClockWarning(2);

        assertThat(report.note(device("a"), EventTime.Fault.AHEAD)).isTrue();
        assertThat(report.note(device("a"), EventTime.Fault.AHEAD)).isFalse();
        assertThat(report.note(device("b"), EventTime.Fault.AHEAD)).isTrue();
        assertThat(report.note(device("c"), EventTime.Fault.AHEAD)).isTrue();
        assertThat(report.note(device("a"), EventTime.Fault.AHEAD))
                .as("only two are remembered")
                .isTrue();
    }

    @Test
    void forgetsTheDeviceThatWasSilentLongest() {
        ClockWarning report = new ClockWarning(2);
        List.of("a", "b", "a", "c").forEach(id -> report.note(device(id), EventTime.Fault.AHEAD));

        assertThat(report.note(device("a"), EventTime.Fault.AHEAD)).isFalse();
        assertThat(report.note(device("b"), EventTime.Fault.AHEAD)).isTrue();
    }

    @Test
    void namesEachFaultOfADevice() {
        ClockWarning report = new ClockWarning();

        assertThat(report.note(device("a"), EventTime.Fault.AHEAD)).isTrue();
        assertThat(report.note(device("a"), EventTime.Fault.UNREADABLE)).isTrue();
        assertThat(report.note(device("a"), EventTime.Fault.UNREADABLE)).isFalse();
    }

    @Test
    void writesOneLineWhateverTheIdHolds() {
        List<String> messages = new ArrayList<>();
        Logger logger = (Logger) LogManager.getLogger(ClockWarning.class);
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
            new ClockWarning(2).note(device("a\nERROR all is lost"), EventTime.Fault.AHEAD);
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

    private static String device(String id) {
        return FiwareScope.of("farm", "/").identity(id);
    }
}
