package io.furrow.control.health;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.annotation.JsonUnwrapped;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.StateRecord;

/**
 * The health of a desired device: stored, and a record of {@code service.devices.health} with the key of
 * {@code service.devices}.
 *
 * @param silent whether it has not reported for longer than its time limit
 * @param since when it became silent or reported again, epoch ms
 */
public record DeviceHealth(
        @JsonUnwrapped Device device,
        boolean silent,
        long since,
        @JsonUnwrapped NewestReport report) implements StateRecord {
    /**
     * The identity of the device.
     *
     * @param id of the entity
     * @param service tenant, empty for the default one
     * @param servicePath {@code /} for the root
     * @param type type of the entity; null if unknown
     */
    public record Device(String id, String service, String servicePath, String type, String domain, String mission) {
        private static Device of(DesiredDevice device, String type) {
            DeviceVersion version = device.version();
            return new Device(
                    version.id(), version.service(), version.servicePath(), type, version.domain(), version.mission());
        }

        private Device typed(String newType) {
            return new Device(id, service, servicePath, newType, domain, mission);
        }
    }

    /**
     * Its newest report.
     *
     * @param lastSeen event time, epoch ms; null if there is none
     * @param heard when it was received, epoch ms, with a delay of at most about 30 s; null if none was
     * @param deviceTime time reported by the device itself, epoch ms; null if none
     * @param battery 0 to 1; null if never reported
     * @param percent whether it ever reported its battery in percent without naming the unit
     * @param off whether it reported that it is switched off; it is never silent then
     */
    public record NewestReport(
            Long lastSeen,
            Long heard,
            Long deviceTime,
            Double battery,
            @JsonInclude(JsonInclude.Include.NON_DEFAULT) boolean percent,
            boolean off) {}

    /** Creates the health of a device that has not reported yet. */
    static DeviceHealth unreported(DesiredDevice device, long now) {
        return new DeviceHealth(
                Device.of(device, device.type()), false, now, new NewestReport(null, null, null, null, false, false));
    }

    DeviceHealth reported(Heartbeat heartbeat, long now) {
        // Its detector, which may have started since, does not know this.
        boolean isSameType = heartbeat.type().equals(device.type);
        boolean knownPercent = report.percent && isSameType;
        Double battery = heartbeat.battery() == null
                ? isSameType ? report.battery : null
                : Double.valueOf(
                        Battery.share(heartbeat.battery(), knownPercent && Boolean.FALSE.equals(heartbeat.percent())));
        return new DeviceHealth(
                device.typed(heartbeat.type()),
                false,
                silent ? now : since,
                new NewestReport(
                        heartbeat.reported(),
                        heartbeat.heard(),
                        heartbeat.deviceTime(),
                        battery,
                        knownPercent || Boolean.TRUE.equals(heartbeat.percent()),
                        heartbeat.off()));
    }

    /** Whether a heartbeat is of another entity with the same id, while that of the desired type reports. */
    boolean isOfOtherType(Heartbeat heartbeat, DesiredDevice desired) {
        return report.heard != null
                && !silent
                && device.type.equalsIgnoreCase(desired.type())
                && !heartbeat.type().equalsIgnoreCase(desired.type());
    }

    DeviceHealth silent(long now) {
        return new DeviceHealth(device, true, now, report);
    }

    /** Returns the health with the device's current domain and mission. */
    DeviceHealth of(DesiredDevice desired) {
        return new DeviceHealth(Device.of(desired, device.type), silent, since, report);
    }

    String key() {
        return new FiwareScope(device.service, device.servicePath).identity(device.id);
    }
}
