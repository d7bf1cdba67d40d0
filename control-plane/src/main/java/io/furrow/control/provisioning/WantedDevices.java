package io.furrow.control.provisioning;

import java.util.Collection;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Set;

import io.furrow.model.device.WantedDevice;
import io.furrow.model.event.FiwareScope;

/** The devices of {@code service.devices} that are to be provisioned, by key, and where there may be some that are to go. */
final class WantedDevices {
    private final Map<String, WantedDevice> devices = new LinkedHashMap<>();
    private final Set<String> fresh = new HashSet<>();
    private final Set<FiwareScope> scopes = new HashSet<>();
    private final FiwareScope usual;
    private boolean live;

    /** @param usual scope that is looked at in any case */
    WantedDevices(FiwareScope usual) {
        this.usual = usual;
        clear();
    }

    /** Knows nothing any more; all is read again. */
    void clear() {
        devices.clear();
        fresh.clear();
        scopes.clear();
        scopes.add(usual);
        live = false;
    }

    /** All that was there has been read; what comes now is new. */
    void caughtUp() {
        live = true;
    }

    /** @param wanted null for a deletion */
    void take(String key, WantedDevice wanted) {
        if (wanted == null || !Registrations.isProvisioned(wanted)) {
            devices.remove(key);
            fresh.remove(key);
            return;
        }
        devices.put(key, wanted);
        if (live) {
            fresh.add(key);
        }
        scopes.add(scope(wanted));
    }

    /** By key. */
    Map<String, WantedDevice> all() {
        return devices;
    }

    /** They are as they are wanted. */
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

    static FiwareScope scope(WantedDevice wanted) {
        return new FiwareScope(wanted.version().service(), wanted.version().servicePath());
    }
}
