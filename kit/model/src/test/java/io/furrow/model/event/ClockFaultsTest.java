package io.furrow.model.event;

import java.util.List;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class ClockFaultsTest {
    @Test
    void namesADeviceOnceUntilItIsForgotten() {
        ClockFaults faults = new ClockFaults("max.skew", 2);

        assertThat(faults.describe(device("a"), EventTime.Fault.AHEAD)).isPresent();
        assertThat(faults.describe(device("a"), EventTime.Fault.AHEAD)).isEmpty();
        assertThat(faults.describe(device("b"), EventTime.Fault.AHEAD)).isPresent();
        assertThat(faults.describe(device("c"), EventTime.Fault.AHEAD)).isPresent();
        assertThat(faults.describe(device("a"), EventTime.Fault.AHEAD))
                .as("only two are remembered")
                .isPresent();
    }

    @Test
    void forgetsTheDeviceThatWasSilentLongest() {
        ClockFaults faults = new ClockFaults("max.skew", 2);
        List.of("a", "b", "a", "c").forEach(id -> faults.describe(device(id), EventTime.Fault.AHEAD));

        assertThat(faults.describe(device("a"), EventTime.Fault.AHEAD)).isEmpty();
        assertThat(faults.describe(device("b"), EventTime.Fault.AHEAD)).isPresent();
    }

    @Test
    void namesEachFaultOfADevice() {
        ClockFaults faults = new ClockFaults("max.skew");

        assertThat(faults.describe(device("a"), EventTime.Fault.AHEAD))
                .hasValueSatisfying(
                        message -> assertThat(message).contains(device("a")).endsWith("or raise max.skew"));
        assertThat(faults.describe(device("a"), EventTime.Fault.UNREADABLE)).isPresent();
        assertThat(faults.describe(device("a"), EventTime.Fault.UNREADABLE)).isEmpty();
    }

    @Test
    void writesOneLineWhateverTheIdHolds() {
        ClockFaults faults = new ClockFaults("max.skew");

        assertThat(faults.describe(device("a\nERROR all is lost"), EventTime.Fault.AHEAD))
                .hasValueSatisfying(message -> assertThat(message)
                        .contains("a\\u000aERROR all is lost")
                        .doesNotContain("\n"));
    }

    private static String device(String id) {
        return FiwareScope.of("farm", "/").identity(id);
    }
}
