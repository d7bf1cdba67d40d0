package io.furrow.control;

import java.time.Duration;
import java.util.List;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

class SensorAlarmsTest {
    private static final Duration WINDOW = Duration.ofSeconds(30);
    private static final String THERMOMETER = "urn:ngsi-ld:Thermometer:m-1";

    @AutoClose
    private final FarmWatchFixture farm = new FarmWatchFixture();

    @Test
    void raisesAnAlarmAfterThreeConsecutiveSuspectWindows() throws Exception {
        pipeSuspectWindows(2);
        farm.temperature("f", 18, List.of());
        farm.pass(WINDOW);
        pipeSuspectWindows(2);
        assertThat(farm.read(Topics.ALARMS)).as("never three in a row").isEmpty();
        farm.temperature("f", 18, List.of(THERMOMETER));
        assertThat(farm.newest(Topics.ALARMS).path("kind").asText()).isEqualTo("suspect-sensor");
        farm.pass(WINDOW);
        farm.temperature("f", 18, List.of());
        farm.pass(WINDOW);
        farm.temperature("f", 18, List.of(THERMOMETER));
        farm.pass(Duration.ofSeconds(89));
        assertThat(farm.read(Topics.ALARMS)).as("one window extends it").isEmpty();
        farm.pass(Duration.ofSeconds(1));
        assertThat(farm.newest(Topics.ALARMS).path("state").asText()).isEqualTo("closed");
    }

    @Test
    void countsEachWindowOnceAndNoUnverifiedOne() throws Exception {
        farm.temperature("f", 18, List.of(THERMOMETER));
        farm.temperature("f", 18, List.of(THERMOMETER));
        farm.temperature("f", 18, List.of(THERMOMETER));
        farm.temperature("g", 18, List.of(THERMOMETER));
        farm.pass(WINDOW);
        pipeSuspectWindows(1);
        farm.unverified("f");
        farm.pass(WINDOW);
        assertThat(farm.read(Topics.ALARMS)).isEmpty();
        pipeSuspectWindows(1);
        assertThat(farm.all(Topics.ALARMS)).hasSize(1);
    }

    @Test
    void ignoresRepeatedWindowsAfterASoundOne() throws Exception {
        byte[] first = farm.temperature("f", 18, List.of(THERMOMETER));
        farm.pass(WINDOW);
        byte[] second = farm.temperature("f", 18, List.of(THERMOMETER));
        farm.pass(WINDOW);
        farm.temperature("f", 18, List.of());
        farm.pipe(Topics.TEMPERATURE, "f", first);
        farm.pipe(Topics.TEMPERATURE, "f", second);
        farm.pass(WINDOW);
        pipeSuspectWindows(2);
        assertThat(farm.read(Topics.ALARMS)).isEmpty();
    }

    @Test
    void goesOnWhenTheClockIsSetBack() throws Exception {
        farm.temperatureOfAClockAhead("f", Duration.ofHours(3));
        pipeSuspectWindows(3);
        assertThat(farm.all(Topics.ALARMS)).hasSize(1);
    }

    @Test
    void ignoresWindowsBeforeOneOfAClockSlightlyAhead() throws Exception {
        farm.temperatureOfAClockAhead("f", Duration.ofSeconds(45));
        pipeSuspectWindows(4);
        assertThat(farm.read(Topics.ALARMS)).isEmpty();
        pipeSuspectWindows(1);
        assertThat(farm.all(Topics.ALARMS)).hasSize(1);
    }

    @Test
    void countsWindowsPerEntityType() throws Exception {
        for (int window = 0; window < 4; window++) {
            farm.temperature("f", 18, List.of(THERMOMETER), List.of(window % 2 == 0 ? "Thermometer" : "Station"));
            farm.pass(WINDOW);
        }
        assertThat(farm.read(Topics.ALARMS)).as("never three in a row").isEmpty();
        for (int window = 0; window < 3; window++) {
            farm.temperature("f", 18, List.of(THERMOMETER, THERMOMETER), List.of("Station", "Thermometer"));
            farm.pass(WINDOW);
        }
        assertThat(farm.all(Topics.ALARMS))
                .extracting(alarm -> alarm.path("identity").asText())
                .containsExactlyInAnyOrder("farm|/|Station|" + THERMOMETER, "farm|/|Thermometer|" + THERMOMETER);
    }

    private void pipeSuspectWindows(int windows) {
        for (int i = 0; i < windows; i++) {
            farm.temperature("f", 18, List.of(THERMOMETER));
            farm.pass(WINDOW);
        }
    }
}
