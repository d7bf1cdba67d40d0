package io.furrow.control.health;

import java.util.Optional;
import java.util.function.Consumer;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.manager.Table;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.ngsi.UnreadableException;

/**
 * The devices of {@code service.devices} that are desired to run now. Unreadable records are skipped.
 *
 * @param records the values of the topic by their keys
 */
record MonitoredDevices(Table<byte[]> records) {
    private static final Logger LOG = LoggerFactory.getLogger(MonitoredDevices.class);

    /** Returns the device of a key; empty if it is not desired. */
    Optional<DesiredDevice> of(String key) {
        byte[] value = records.get(key);
        return value == null ? Optional.empty() : running(value);
    }

    void forEach(Consumer<DesiredDevice> each) {
        records.forEach(value -> running(value).ifPresent(each));
    }

    private static Optional<DesiredDevice> running(byte[] value) {
        try {
            DesiredDevice device = DesiredDevice.read(value);
            return device.running() && device.version().until() == null ? Optional.of(device) : Optional.empty();
        } catch (UnreadableException e) {
            LOG.debug("an unreadable record of service.devices is skipped", e);
            return Optional.empty();
        }
    }
}
