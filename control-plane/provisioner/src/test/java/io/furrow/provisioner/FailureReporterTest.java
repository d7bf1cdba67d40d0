package io.furrow.provisioner;

import java.util.List;
import java.util.Map;

import org.apache.kafka.clients.producer.MockProducer;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceStatus;

import static org.assertj.core.api.Assertions.assertThat;

class FailureReporterTest {
    private final MockProducer<String, byte[]> producer =
            new MockProducer<>(true, null, new StringSerializer(), new ByteArraySerializer());
    private final DesiredDeviceTable desired = new DesiredDeviceTable(DesiredDeviceFixture.SCOPE);
    private final FailureReporter failures = new FailureReporter(desired, producer);
    private final DesiredDevice device = DesiredDeviceFixture.thermometer("hoeing", 1);
    private final String key = device.version().key();

    @BeforeEach
    void addDesired() {
        desired.caughtUp();
        desired.take(key, device);
    }

    @Test
    void reportsThatTheAgentIsUnavailableAfterThreeFailuresInARow() throws Exception {
        failures.unavailable("no answer");
        failures.unavailable("no answer");
        assertThat(producer.history()).isEmpty();

        failures.unavailable("no answer");
        failures.unavailable("no answer");

        assertThat(producer.history()).hasSize(1);
        DeviceStatus status = DeviceStatus.read(producer.history().get(0).value());
        assertThat(status.reason()).isEqualTo("not provisioned: no answer");
    }

    @Test
    void reportsNothingWhileASlowAgentMakesProgress() {
        for (int i = 0; i < 10; i++) {
            failures.unavailable("no answer");
            failures.unavailable("no answer");
            failures.available();
        }

        assertThat(producer.history()).isEmpty();
    }

    @Test
    void reportsADeviceThatAnAvailableAgentRejectedThreeTimes() {
        for (int i = 0; i < 3; i++) {
            failures.available();
            failures.rejected(Map.of(key, "not you"));
        }

        assertThat(List.copyOf(producer.history())).hasSize(1);
    }
}
