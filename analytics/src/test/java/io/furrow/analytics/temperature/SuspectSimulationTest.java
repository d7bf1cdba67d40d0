package io.furrow.analytics.temperature;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;

/** How often sound and defective devices are named, with the default options. */
@Tag("full")
class SuspectSimulationTest {
    private static final SuspectSimulation SIMULATION = SuspectSimulation.byDefault();

    @ParameterizedTest(name = "votes rounded to {0}")
    @ValueSource(doubles = {0, 0.1, 0.5})
    void namesASoundDeviceInOneWindowOfAHundredAtMost(double step) {
        assertThat(SIMULATION.soundNamed(step))
                .allSatisfy((devices, share) -> assertThat(share).isLessThanOrEqualTo(0.01));
    }

    @ParameterizedTest(name = "votes rounded to {0}")
    @ValueSource(doubles = {0, 0.1, 0.5})
    void namesADeviceThatIsFiveSigmaOffWithinThreeWindows(double step) {
        int fewest = step == 0.5 ? 5 : 4;

        assertThat(SIMULATION.namedWithin(3, 5, step))
                .allSatisfy((devices, share) -> assertThat(share).isGreaterThanOrEqualTo(devices >= fewest ? 0.95 : 0));
    }

    @ParameterizedTest(name = "{0} devices")
    @ValueSource(ints = {5, 6, 7, 10, 20})
    void namesTwoThatAreFarOffInTheSameWindow(int devices) {
        for (double step : List.of(0.0, 0.1, 0.5)) {
            assertThat(SIMULATION.namedWithin(1, devices, step, 20, 20)).isGreaterThan(0.95);
            assertThat(SIMULATION.namedWithin(1, devices, step, 20, -20)).isGreaterThan(0.95);
        }
    }

    @Test
    void isDrawnInTheDocumentation() throws Exception {
        String drawn = SuspectFigure.of(SuspectSimulation.byDefault());
        Files.writeString(Path.of("target", "suspects.svg"), drawn);

        if (SIMULATION.trials() == 10_000) {
            assertThat(Path.of("..", "docs", "suspects.svg"))
                    .as("docs/suspects.svg; this run's is analytics/target/suspects.svg")
                    .hasContent(drawn);
        }
    }
}
