package io.furrow.analytics.temperature;

import java.nio.file.Path;
import java.time.Duration;

import org.assertj.core.api.ThrowableAssert.ThrowingCallable;
import org.junit.jupiter.api.Test;
import picocli.CommandLine.ParameterException;

import io.furrow.flink.JobUids;
import io.furrow.flink.job.JobCommandLine;

import static io.furrow.analytics.temperature.Farm.FIELDS;
import static io.furrow.analytics.temperature.Farm.options;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class TemperatureOptionsTest {
    @Test
    void haveTheDefaultsThatTheHelpNames() {
        TemperatureOptions options = options(FIELDS);

        assertThat(options.jobName()).isEqualTo("temperature");
        assertThat(options.attribute()).isEqualTo("Temperature");
        assertThat(options.window()).isEqualTo(Duration.ofMinutes(1));
        assertThat(options.slide()).isEqualTo(Duration.ofMinutes(1));
        assertThat(options.allowedLateness()).isZero();
        assertThat(options.suspectFloor()).isEqualTo(0.5);
        assertThat(options.output()).isEqualTo("data.temperature");
        assertThat(options.lateOutput()).isEqualTo("data.temperature.late");
    }

    @Test
    void rememberEventsForAsLongAsARepetitionCouldCount() {
        TemperatureOptions options = options(FIELDS, "--window", "5min", "--allowed-lateness", "1min");

        assertThat(options.repeatWindow()).isEqualTo(Duration.ofMinutes(6));
        assertThat(options(FIELDS, "--repeat-window", "1h").repeatWindow()).isEqualTo(Duration.ofHours(1));
    }

    @Test
    void refuseWindowsThatDoNotFitTheirSlide() {
        assertThat(options(FIELDS, "--slide", "20s").slide()).isEqualTo(Duration.ofSeconds(20));
        assertRefused(() -> options(FIELDS, "--slide", "25s").slide(), "--slide must be a whole part of --window");
        assertThat(options(FIELDS, "--window", "1d", "--slide", "1min").slide()).isEqualTo(Duration.ofMinutes(1));
        assertRefused(
                () -> options(FIELDS, "--window", "1d", "--slide", "1ms").slide(),
                "--slide puts each reading into more than 1440 windows");
    }

    @Test
    void refuseWhatIsNoLengthOfTime() {
        assertRefused(() -> options(FIELDS, "--window", "0s").window(), "--window must be longer than 0");
        assertRefused(() -> options(FIELDS, "--suspect-floor", "-1").suspectFloor(), "--suspect-floor must be 0 or");
    }

    @Test
    void readTheFieldsFromTheirTopicUnlessAFileIsNamed() {
        TemperatureOptions options = new TemperatureOptions();
        JobCommandLine.of(options).parseArgs("--fields-topic", "service.fields.copy");

        assertThat(options.fields().topic()).isEqualTo("service.fields.copy");
        assertThat(JobUids.of(TemperatureJob.assemble(options))).isEqualTo(JobUids.checkedIn("temperature"));
    }

    @Test
    void nameTheJobAfterAnyOtherAttribute() {
        assertThat(options(FIELDS, "--attribute", "soilMoisture").jobName()).isEqualTo("temperature-soilMoisture");
        assertThat(options(FIELDS, "--attribute", "soil:moisture").jobName()).isEqualTo("temperature-soil.moisture");
        assertRefused(
                () -> options(FIELDS, "--attribute", "soil moisture").attribute(), "--attribute must be 1 to 40 of");
    }

    @Test
    void knowHowMuchSoundDevicesDifferOfATemperatureOnly() {
        assertThat(options(FIELDS, "--suspect-floor", "0.9").suspectFloor()).isEqualTo(0.9);
        assertThat(options(FIELDS, "--attribute", "soilMoisture", "--suspect-floor", "0")
                        .suspectFloor())
                .isZero();
        assertThatThrownBy(() -> TemperatureJob.assemble(options(FIELDS, "--attribute", "soilMoisture")))
                .isInstanceOf(ParameterException.class)
                .hasMessageStartingWith(
                        "--attribute soilMoisture needs --suspect-floor: by how much two sound devices");
    }

    @Test
    void refuseToStartWithoutUsableFields() {
        assertThatThrownBy(() -> TemperatureJob.assemble(options(Path.of("no.geojson"))))
                .isInstanceOf(ParameterException.class)
                .hasMessage("--fields no.geojson: cannot be read; name a readable GeoJSON file");
    }

    private static void assertRefused(ThrowingCallable option, String reason) {
        assertThatThrownBy(option).isInstanceOf(ParameterException.class).hasMessageContaining(reason);
    }
}
