package io.furrow.control.health;

import io.furrow.control.manager.StateJson;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.event.FiwareScope;

/**
 * The health of a desired device: stored, and a record of {@code service.devices.health} with the key of
 * {@code service.devices}.
 *
 * @param id of the entity
 * @param service tenant, empty for the default one
 * @param servicePath {@code /} for the root
 * @param type type of the entity; null if unknown
 * @param silent whether it has not reported for longer than its time limit
 * @param since when it became silent or reported again, epoch ms
 * @param lastSeen event time of its newest report, epoch ms; null if none
 * @param heard when that report arrived, epoch ms, at most about 30 s behind; null if none
 * @param deviceTime what the device itself gave as the time of that report, epoch ms; null if it gave none
 * @param battery 0 to 1; null if never reported
 * @param off whether it reported that it is switched off; it is never silent then
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
        Long deviceTime,
        Double battery,
        boolean off) {

    /** Creates the health of a device that has not reported yet. */
    static DeviceHealth unheard(DesiredDevice device, long now) {
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
                null,
                false);
    }

    DeviceHealth heard(Heartbeat heartbeat, long now) {
        return new DeviceHealth(
                id,
                service,
                servicePath,
                heartbeat.type(),
                domain,
                mission,
                false,
                silent ? now : since,
                heartbeat.reported(),
                heartbeat.heard(),
                heartbeat.deviceTime(),
                heartbeat.battery() == null ? battery : heartbeat.battery(),
                heartbeat.off());
    }

    DeviceHealth silent(long now) {
        return new DeviceHealth(
                id, service, servicePath, type, domain, mission, true, now, lastSeen, heard, deviceTime, battery, off);
    }

    /** Returns the health with the device's current domain and mission. */
    DeviceHealth of(DesiredDevice device) {
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
                deviceTime,
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
