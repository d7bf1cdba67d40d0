package io.furrow.control.health;

import java.util.Optional;
import java.util.function.Consumer;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.manager.record.Records;
import io.furrow.model.device.WantedDevice;
import io.furrow.model.ngsi.UnreadableException;

/** The devices of {@code service.devices} that are desired to run now. Unreadable records are skipped. */
public final class WantedDevices {
    private static final Logger LOG = LoggerFactory.getLogger(WantedDevices.class);

    private final Records<byte[]> records;

    /** @param records the values of the topic by their keys */
    public WantedDevices(Records<byte[]> records) {
        this.records = records;
    }

    /** Returns the device of a key; empty if none is desired or no longer. */
    public Optional<WantedDevice> of(String key) {
        byte[] value = records.get(key);
        return value == null ? Optional.empty() : running(value);
    }

    void forEach(Consumer<WantedDevice> each) {
        records.forEach(value -> running(value).ifPresent(each));
    }

    private static Optional<WantedDevice> running(byte[] value) {
        try {
            WantedDevice device = WantedDevice.read(value);
            return device.running() && device.version().until() == null ? Optional.of(device) : Optional.empty();
        } catch (UnreadableException e) {
            LOG.debug("an unreadable record of service.devices is skipped", e);
            return Optional.empty();
        }
    }
}
