package io.furrow.control.health;

import io.furrow.control.manager.StateJson;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.device.WantedDevice;
import io.furrow.model.event.FiwareScope;

/**
 * How it is with a device that is wanted: remembered, and a record of {@code service.devices.health} under the key of {@code
 * service.devices}.
 *
 * @param id of the entity
 * @param service tenant, empty for the default one
 * @param servicePath {@code /} for the root
 * @param type of the entity; null where it is not known
 * @param silent whether it was not heard of for longer than it may be
 * @param since when it became silent or was heard of again, epoch ms
 * @param lastSeen event time of its newest report, epoch ms; null where there was none
 * @param heard when that came in, epoch ms, some 30 s behind at most; null where nothing did
 * @param battery 0 to 1; null where it never said
 * @param off whether it said that it is switched off: then it may be silent
 */
public record DeviceHealth(
        String id,
        String service,
        String servicePath,
        String type,
        String domain,
        String mission,
        boolean silent,
        long since,
        Long lastSeen,
        Long heard,
        Double battery,
        boolean off) {

    /** Nothing was heard of it yet. */
    static DeviceHealth unheard(WantedDevice device, long now) {
        DeviceVersion version = device.version();
        return new DeviceHealth(
                version.id(),
                version.service(),
                version.servicePath(),
                device.type(),
                version.domain(),
                version.mission(),
                false,
                now,
                null,
                null,
                null,
                false);
    }

    DeviceHealth heard(Sign sign, long now) {
        return new DeviceHealth(
                id,
                service,
                servicePath,
                sign.type(),
                domain,
                mission,
                false,
                silent ? now : since,
                sign.reported(),
                sign.heard(),
                sign.battery() == null ? battery : sign.battery(),
                sign.off());
    }

    DeviceHealth silent(long now) {
        return new DeviceHealth(
                id, service, servicePath, type, domain, mission, true, now, lastSeen, heard, battery, off);
    }

    /** The same on the mission that it is on now. */
    DeviceHealth of(WantedDevice device) {
        DeviceVersion version = device.version();
        return new DeviceHealth(
                id,
                service,
                servicePath,
                type,
                version.domain(),
                version.mission(),
                silent,
                since,
                lastSeen,
                heard,
                battery,
                off);
    }

    String key() {
        return new FiwareScope(service, servicePath).identity(id);
    }

    byte[] toBytes() {
        return StateJson.write(this);
    }
}
