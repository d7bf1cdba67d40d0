package io.furrow.provisioner;

import java.util.Collection;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.device.MissionDeviceLists;
import io.furrow.model.device.WantedDevice;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.UnreadableException;

/** The devices of {@code service.devices} that are to be provisioned, by key, and where there may be some that are to go. */
final class WantedDevices {
    private static final Logger LOG = LoggerFactory.getLogger(WantedDevices.class);

    private final Map<String, WantedDevice> devices = new LinkedHashMap<>();
    private final MissionDeviceLists lists = new MissionDeviceLists();
    /** Those whose settings are not known yet; until then what was known of them before holds. */
    private final Map<String, WantedDevice> unresolved = new LinkedHashMap<>();

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

    /** @param wanted null for a deletion */
    void take(String key, WantedDevice wanted) {
        if (wanted == null || !Registrations.isProvisioned(wanted)) {
            devices.remove(key);
            unresolved.remove(key);
            fresh.remove(key);
            return;
        }
        resolve(wanted).ifPresentOrElse(complete -> devices.put(key, complete), () -> unresolved.put(key, wanted));
        if (live) {
            fresh.add(key);
        }
        scopes.add(scope(wanted));
    }

    /** A part of a mission's device list; null for one that was deleted. */
    void takeList(String key, byte[] value) {
        lists.take(key, value);
        unresolved.entrySet().removeIf(each -> {
            Optional<WantedDevice> complete = resolve(each.getValue());
            complete.ifPresent(device -> devices.put(each.getKey(), device));
            return complete.isPresent();
        });
    }

    private Optional<WantedDevice> resolve(WantedDevice wanted) {
        try {
            return lists.resolve(wanted);
        } catch (UnreadableException e) {
            LOG.warn(
                    "the device list of mission {} cannot be read",
                    wanted.version().mission(),
                    e);
            return Optional.empty();
        }
    }

    /** By key. */
    Map<String, WantedDevice> all() {
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

    static FiwareScope scope(WantedDevice wanted) {
        return new FiwareScope(wanted.version().service(), wanted.version().servicePath());
    }
}
