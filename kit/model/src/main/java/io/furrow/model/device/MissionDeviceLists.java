package io.furrow.model.device;

import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Optional;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.UnreadableException;

/**
 * Caches the records of {@code service.missions.devices} for processes that run or provision devices. Parts are stored
 * as bytes because trees need ten times the memory; the last {@value #MAX_PARSED} used ones are also cached as trees,
 * because devices of a group are resolved together. Not thread-safe.
 */
public final class MissionDeviceLists {
    private static final int MAX_PARSED = 8;

    private final Map<String, byte[]> parts = new HashMap<>();
    private final Map<String, MissionDeviceList> parsed = new LinkedHashMap<>(16, 0.75f, true) {
        private static final long serialVersionUID = 1L;

        @Override
        protected boolean removeEldestEntry(Map.Entry<String, MissionDeviceList> eldest) {
            return size() > MAX_PARSED;
        }
    };

    /** @param value null removes the part */
    public void take(String key, byte[] value) {
        parsed.remove(key);
        if (value == null) {
            parts.remove(key);
        } else {
            parts.put(key, value);
        }
    }

    /**
     * Returns the device with its settings; empty if a newer record of the part or the device is still to come.
     *
     * @throws UnreadableException if the part is invalid
     */
    public Optional<DesiredDevice> resolve(DesiredDevice device) throws UnreadableException {
        GroupRef group = device.group();
        if (group == null) {
            return Optional.of(device);
        }
        String key = MissionDeviceList.key(device.version().mission(), group.part());
        MissionDeviceList part = parsed.get(key);
        if (part == null && parts.containsKey(key)) {
            part = MissionDeviceList.read(parts.get(key));
            parsed.put(key, part);
        }
        if (part == null || part.sequence() != group.sequence()) {
            return Optional.empty();
        }
        ObjectNode settings = part.settings(group);
        return Optional.of(device.with(settings));
    }

    public void clear() {
        parts.clear();
        parsed.clear();
    }
}
