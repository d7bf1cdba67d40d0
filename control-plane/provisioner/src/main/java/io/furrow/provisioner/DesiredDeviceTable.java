package io.furrow.provisioner;

import java.util.Collection;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.TreeSet;
import java.util.stream.Collectors;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.control.Fault;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.MissionDeviceLists;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Holds the devices of {@code service.devices} that are to be provisioned, by key, and the scopes in which the agent may have others. */
final class DesiredDeviceTable {
    private static final Logger LOG = LoggerFactory.getLogger(DesiredDeviceTable.class);

    private static final int MAX_NAMED = 10;

    private final Map<String, DesiredDevice> devices = new LinkedHashMap<>();
    private final MissionDeviceLists lists = new MissionDeviceLists();
    /** Devices whose device list was not read yet; until then their previous version applies. */
    private final Map<String, DesiredDevice> unresolved = new LinkedHashMap<>();

    /** Keys of the records that cannot be read; until they are replaced their previous version applies. */
    private final Set<String> unreadable = new TreeSet<>();

    private final Set<String> fresh = new HashSet<>();
    private final Set<FiwareScope> scopes = new HashSet<>();
    private final FiwareScope defaultScope;
    private boolean live;

    /** @param defaultScope scope that is always reconciled */
    DesiredDeviceTable(FiwareScope defaultScope) {
        this.defaultScope = defaultScope;
        clear();
    }

    void clear() {
        devices.clear();
        lists.clear();
        unresolved.clear();
        unreadable.clear();
        fresh.clear();
        scopes.clear();
        scopes.add(defaultScope);
        live = false;
    }

    /** Called once all existing records were read; later records are new. */
    void caughtUp() {
        live = true;
    }

    /** @param desired null for a deletion */
    void take(String key, DesiredDevice desired) {
        unreadable.remove(key);
        if (desired == null || !AgentRegistrationFactory.isProvisioned(desired)) {
            devices.remove(key);
            unresolved.remove(key);
            fresh.remove(key);
            return;
        }
        unresolved.remove(key);
        resolve(desired).ifPresentOrElse(complete -> devices.put(key, complete), () -> unresolved.put(key, desired));
        if (live) {
            fresh.add(key);
        }
        scopes.add(scope(desired));
    }

    void takeUnreadable(String key) {
        unreadable.add(key);
    }

    /** Updates a part of a mission's device list. @param value null for a deletion */
    void takeList(String key, byte[] value) {
        lists.take(key, value);
        unresolved.entrySet().removeIf(each -> {
            Optional<DesiredDevice> complete = resolve(each.getValue());
            complete.ifPresent(device -> devices.put(each.getKey(), device));
            return complete.isPresent();
        });
    }

    private Optional<DesiredDevice> resolve(DesiredDevice desired) {
        try {
            return lists.resolve(desired);
        } catch (UnreadableException e) {
            LOG.warn(
                    "the device list of mission {} cannot be read",
                    desired.version().mission(),
                    e);
            return Optional.empty();
        }
    }

    /**
     * Returns devices that are desired, but not how: their record refers to another version of their mission's device
     * list than the one that was read. Nothing of them is removed.
     */
    Collection<DesiredDevice> undecided() {
        return unresolved.values();
    }

    boolean hasUnreadable() {
        return !unreadable.isEmpty();
    }

    /** Returns the keys of the undecided devices, and of those whose record cannot be read. */
    Set<String> undecidedKeys() {
        Set<String> keys = new TreeSet<>(unreadable);
        keys.addAll(unresolved.keySet());
        return keys;
    }

    /** Returns which devices are undecided or cannot be read, and what to do. */
    Fault undecidedFault() {
        Set<String> keys = undecidedKeys();
        String named = keys.stream().limit(MAX_NAMED).collect(Collectors.joining(", "))
                + (keys.size() > MAX_NAMED ? ", …" : "");
        String text =
                "the desired state of %d devices cannot be read (%s): their records on %s, or the device lists of their missions, are of another version; they keep their logins and registrations, but no changes; update Furrow here, or start their missions again"
                        .formatted(keys.size(), named, Topics.DEVICES);
        return new Fault(text, "devices-undecided", Map.of("count", String.valueOf(keys.size()), "devices", named));
    }

    Map<String, DesiredDevice> all() {
        return devices;
    }

    /** Called when devices are in the desired state. */
    void provisioned(Collection<String> keys) {
        fresh.removeAll(keys);
    }

    /** Whether a device was requested or changed after the existing records were read, and is not provisioned yet. */
    boolean isFresh(String key) {
        return fresh.contains(key);
    }

    Set<FiwareScope> scopes() {
        return scopes;
    }

    static FiwareScope scope(DesiredDevice desired) {
        return new FiwareScope(desired.version().service(), desired.version().servicePath());
    }
}
