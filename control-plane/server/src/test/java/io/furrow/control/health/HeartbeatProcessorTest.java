package io.furrow.control.health;

import java.time.Duration;
import java.util.List;

import org.apache.kafka.common.serialization.Serdes;
import org.apache.kafka.streams.processor.api.MockProcessorContext;
import org.apache.kafka.streams.processor.api.Record;
import org.apache.kafka.streams.state.KeyValueStore;
import org.apache.kafka.streams.state.Stores;
import org.junit.jupiter.api.Test;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;

class HeartbeatProcessorTest {
    private static final String ID = "urn:t:1";

    private final MockProcessorContext<String, byte[]> context = new MockProcessorContext<>();
    private final HeartbeatProcessor processor = new HeartbeatProcessor(HealthOptions.DEFAULT);
    private long now = 1_700_000_000_000L;

    @Test
    void emitsPulsesWhenTheClockIsSetBack() {
        KeyValueStore<String, byte[]> desired = Stores.keyValueStoreBuilder(
                        Stores.inMemoryKeyValueStore("desired-devices"), Serdes.String(), Serdes.ByteArray())
                .withLoggingDisabled()
                .build();
        desired.init(context.getStateStoreContext(), desired);
        context.addStateStore(desired);
        DeviceVersion version = new DeviceVersion(ID, "", "/", "d", "m", 0, null, 1, null);
        desired.put(
                version.key(),
                DesiredDevice.simulated(version, "T", ID, true, Duration.ofSeconds(10), NgsiJson.object())
                        .toBytes());
        context.setCurrentSystemTimeMs(now);
        processor.init(context);

        report(0);
        assertThat(pulses()).as("the first").isOne();
        report(4_999);
        assertThat(pulses()).as("every five seconds").isOne();
        report(1);
        assertThat(pulses()).isEqualTo(2);
        report(-7_200_000);
        assertThat(pulses()).isEqualTo(3);
    }

    private void report(long later) {
        now += later;
        context.setCurrentSystemTimeMs(now);
        byte[] entity = Entity.builder(ID, "T").number("temperature", now).toBytes();
        processor.process(new Record<>(ID, entity, now));
    }

    private long pulses() {
        List<MockProcessorContext.CapturedForward<? extends String, ? extends byte[]>> forwarded = context.forwarded();
        return forwarded.stream()
                .filter(each -> each.record().key().equals(Heartbeat.PULSE_KEY))
                .count();
    }
}
