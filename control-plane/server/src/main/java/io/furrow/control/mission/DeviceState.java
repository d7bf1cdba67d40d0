package io.furrow.control.mission;

import com.fasterxml.jackson.annotation.JsonProperty;
import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.control.health.SilenceCause;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceConnection;
import io.furrow.model.ngsi.NgsiJson;

/**
 * A requested device as stored by its key.
 *
 * @param desired the record of {@code service.devices}
 * @param confirmed whether it is in the desired state: its host confirmed it, or a real device has reported
 * @param reason why it is not, as reported by its host or the provisioner; null if not reported
 * @param forgotten whether only its generation is retained, because its mission was deleted
 * @param connection connection of a real device as of the last change of its explanation; null if unknown
 */
record DeviceState(
        @JsonProperty("wanted") JsonNode desired,
        boolean confirmed,
        String reason,
        boolean forgotten,
        DeviceConnection connection) {
    /** @param before null if it was never requested */
    static DeviceState requested(DesiredDevice device, DeviceState before) {
        DeviceConnection connection = before == null ? null : before.connection();
        JsonNode json = NgsiJson.own(() -> NgsiJson.read(device.toBytes()));
        return new DeviceState(json, false, null, false, connection);
    }

    DesiredDevice device() {
        return NgsiJson.own(() -> DesiredDevice.read(NgsiJson.write(desired)));
    }

    String mission() {
        return desired.path("mission").asText();
    }

    DeviceState reported(boolean asDesired, String why) {
        return new DeviceState(desired, asDesired, why, forgotten, connection);
    }

    /** Returns the same instance if the connection explains nothing new. */
    DeviceState connected(DeviceConnection newConnection) {
        DeviceState next = new DeviceState(desired, confirmed, reason, forgotten, newConnection);
        return next.silence().replaces(silence()) ? next : this;
    }

    private SilenceCause silence() {
        return SilenceCause.ofUnheard(connection, reason, device().version().from());
    }

    MissionStatus.Missing missing() {
        DesiredDevice device = device();
        String id = device.version().id();
        if (device.running() && !device.simulated()) {
            SilenceCause cause = silence();
            return new MissionStatus.Missing(id, cause.text(), cause.code(), cause.values());
        }
        if (device.running() && reason == null) {
            String why = "nothing simulates it: start ./furrow up with --simulate-devices, or ./furrow device-host";
            return new MissionStatus.Missing(id, why, "not-simulated", null);
        }
        return new MissionStatus.Missing(id, reason);
    }

    DeviceState asForgotten() {
        return new DeviceState(desired, confirmed, reason, true, null);
    }

    /** Returns how often its credentials were rotated. */
    int generation() {
        return desired.path("generation").asInt();
    }
}
