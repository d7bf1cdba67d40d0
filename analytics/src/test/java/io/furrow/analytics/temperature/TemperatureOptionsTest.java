package io.furrow.analytics.temperature;

import java.nio.file.Path;
import java.time.Duration;

import org.junit.jupiter.api.Test;
import picocli.CommandLine.ParameterException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class TemperatureOptionsTest {
    @Test
    void haveTheDefaultsThatTheHelpNames() {
        TemperatureOptions options = Farm.options(Farm.FIELDS);

        assertThat(options.jobName()).isEqualTo("temperature");
        assertThat(options.attribute()).isEqualTo("Temperature");
        assertThat(options.window()).isEqualTo(Duration.ofMinutes(1));
        assertThat(options.slide()).isEqualTo(Duration.ofMinutes(1));
        assertThat(options.allowedLateness()).isZero();
        assertThat(options.madFloor()).isZero();
        assertThat(options.output()).isEqualTo("data.temperature");
        assertThat(options.lateOutput()).isEqualTo("data.temperature.late");
    }

    @Test
    void rememberEventsForAsLongAsARepetitionCouldCount() {
        TemperatureOptions options = Farm.options(Farm.FIELDS, "--window", "5min", "--allowed-lateness", "1min");

        assertThat(options.repeatWindow()).isEqualTo(Duration.ofMinutes(6));
        assertThat(Farm.options(Farm.FIELDS, "--repeat-window", "1h").repeatWindow())
                .isEqualTo(Duration.ofHours(1));
    }

    @Test
    void refuseWindowsThatDoNotFitTheirSlide() {
        assertThat(Farm.options(Farm.FIELDS, "--slide", "20s").slide()).isEqualTo(Duration.ofSeconds(20));
        assertThatThrownBy(() -> Farm.options(Farm.FIELDS, "--slide", "25s").slide())
                .isInstanceOf(ParameterException.class)
                .hasMessageContaining("--slide must be a whole part of --window");
    }

    @Test
    void refuseWhatIsNoLengthOfTime() {
        assertThatThrownBy(() -> Farm.options(Farm.FIELDS, "--window", "0s").window())
                .isInstanceOf(ParameterException.class)
                .hasMessageContaining("--window must be longer than 0");
        assertThatThrownBy(() -> Farm.options(Farm.FIELDS, "--mad-floor", "-1").madFloor())
                .isInstanceOf(ParameterException.class)
                .hasMessageContaining("--mad-floor");
    }

    @Test
    void refuseToStartWithoutUsableFields() {
        assertThatThrownBy(() -> TemperatureJob.assemble(Farm.options(Path.of("no.geojson"))))
                .isInstanceOf(ParameterException.class)
                .hasMessage("--fields no.geojson: cannot be read; name a readable GeoJSON file");
    }
}
