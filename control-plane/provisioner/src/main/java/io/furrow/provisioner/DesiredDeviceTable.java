package io.furrow.provisioner;

import java.util.Collection;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.MissionDeviceLists;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.UnreadableException;

/** The devices of {@code service.devices} that are to be provisioned, by key, and where there may be some that are to go. */
final class DesiredDeviceTable {
    private static final Logger LOG = LoggerFactory.getLogger(DesiredDeviceTable.class);

    private final Map<String, DesiredDevice> devices = new LinkedHashMap<>();
    private final MissionDeviceLists lists = new MissionDeviceLists();
    /** Those whose settings are not known yet; until then what was known of them before holds. */
    private final Map<String, DesiredDevice> unresolved = new LinkedHashMap<>();

    private final Set<String> fresh = new HashSet<>();
    private final Set<FiwareScope> scopes = new HashSet<>();
    private final FiwareScope usual;
    private boolean live;

    /** @param usual scope that is looked at in any case */
    DesiredDeviceTable(FiwareScope usual) {
        this.usual = usual;
        clear();
    }

    /** Knows nothing any more; all is read again. */
    void clear() {
        devices.clear();
        lists.clear();
        unresolved.clear();
        fresh.clear();
        scopes.clear();
        scopes.add(usual);
        live = false;
    }

    /** All that was there has been read; what comes now is new. */
    void caughtUp() {
        live = true;
    }

    /** @param desired null for a deletion */
    void take(String key, DesiredDevice desired) {
        if (desired == null || !AgentRegistrationFactory.isProvisioned(desired)) {
            devices.remove(key);
            unresolved.remove(key);
            fresh.remove(key);
            return;
        }
        resolve(desired).ifPresentOrElse(complete -> devices.put(key, complete), () -> unresolved.put(key, desired));
        if (live) {
            fresh.add(key);
        }
        scopes.add(scope(desired));
    }

    /** A part of a mission's device list; null for one that was deleted. */
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

    /** By key. */
    Map<String, DesiredDevice> all() {
        return devices;
    }

    /** They are in the desired state. */
    void provisioned(Collection<String> keys) {
        fresh.removeAll(keys);
    }

    /** Whether a device has become wanted, or wanted otherwise, since everything was read, and has not been provisioned yet. */
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
