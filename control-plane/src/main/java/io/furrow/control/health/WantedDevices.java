package io.furrow.control.health;

import java.util.Optional;
import java.util.function.Consumer;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.manager.Records;
import io.furrow.model.device.WantedDevice;
import io.furrow.model.ngsi.UnreadableException;

/** The devices that shall run now, as {@code service.devices} has them; what cannot be read there is none. */
public final class WantedDevices {
    private static final Logger LOG = LoggerFactory.getLogger(WantedDevices.class);

    private final Records<byte[]> records;

    /** @param records the values of the topic by their keys */
    public WantedDevices(Records<byte[]> records) {
        this.records = records;
    }

    /** Empty where none is wanted under the key, or only was. */
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
            LOG.debug("a record of service.devices is passed over", e);
            return Optional.empty();
        }
    }
}
