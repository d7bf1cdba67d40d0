package io.furrow.model.device;

import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Optional;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.UnreadableException;

/**
 * The records of {@code service.missions.devices}, for those who run or provision devices. Parts are kept as bytes, because a tree
 * takes ten times the room; the last {@value #PARSED} that were asked for are kept as trees, because devices of one group come
 * together. For one thread.
 */
public final class MissionDeviceLists {
    private static final int PARSED = 8;

    private final Map<String, byte[]> parts = new HashMap<>();
    private final Map<String, MissionDeviceList> parsed = new LinkedHashMap<>(16, 0.75f, true) {
        private static final long serialVersionUID = 1L;

        @Override
        protected boolean removeEldestEntry(Map.Entry<String, MissionDeviceList> eldest) {
            return size() > PARSED;
        }
    };

    /** @param value null takes the part away */
    public void take(String key, byte[] value) {
        parsed.remove(key);
        if (value == null) {
            parts.remove(key);
        } else {
            parts.put(key, value);
        }
    }

    /**
     * The device with its settings in itself; empty if they are not known yet, or not any more: then a record is to come, of the
     * part or of the device.
     *
     * @throws UnreadableException where the part is no such record
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
