package io.furrow.provisioner;

import java.time.Duration;
import java.util.List;
import java.util.Map;

import org.apache.kafka.clients.producer.MockProducer;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.model.control.Fault;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

class FailureReporterTest {
    private long nanos = Long.MAX_VALUE - 5;
    private final MockProducer<String, byte[]> producer =
            new MockProducer<>(true, null, new StringSerializer(), new ByteArraySerializer());
    private final DesiredDeviceTable desired = new DesiredDeviceTable(DesiredDeviceFixture.SCOPE);
    private final FailureReporter failures = new FailureReporter(desired, producer, () -> nanos);
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
    void reportsUndecidedDevicesOnceAMinute() throws Exception {
        pass(120);
        desired.takeUnreadable(key);
        pass(59);
        assertThat(producer.history()).as("its list may come").isEmpty();
        pass(1);
        assertThat(producer.history()).hasSize(1);
        pass(59);
        assertThat(producer.history()).hasSize(1);
        pass(1);
        assertThat(producer.history()).hasSize(2).allMatch(each -> each.topic().equals(Topics.FAULTS));
        assertThat(Fault.read(producer.history().get(0).value()).text()).contains("1 devices", key);

        desired.take(key, device);
        pass(120);
        assertThat(producer.history()).hasSize(2);
    }

    private void pass(int seconds) {
        nanos += Duration.ofSeconds(seconds).toNanos();
        failures.undecided();
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
