package io.furrow.model.device;

import java.time.DateTimeException;
import java.time.Duration;
import java.util.Objects;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * A record of {@code service.devices} as the control plane writes it: to whom the device belongs, which is all that jobs read,
 * and what its host shall run. Whoever hosts devices brings what runs in line with what is wanted and says so on {@code
 * service.devices.status}, see {@link DeviceStatus}.
 *
 * @param type of the entity; null where the device reports by itself and nobody is asked to run it
 * @param device id at the IoT Agent and in MQTT topics; null where {@code type} is
 * @param running false where it shall be taken away; {@code version} then has an end
 * @param period between two measures; null where the host chooses
 * @param settings {@code area}, {@code path}, {@code speed}, {@code faults}, {@code parameters}; owned by the record
 */
public record WantedDevice(
        DeviceVersion version, String type, String device, boolean running, Duration period, ObjectNode settings) {
    private static final String SETTINGS = "settings";

    public WantedDevice {
        Objects.requireNonNull(version);
        Objects.requireNonNull(settings);
    }

    /** Whether somebody is asked to run it. */
    public boolean isHosted() {
        return type != null;
    }

    /**
     * Reads the value of a record; one that says no more than to whom the device belongs is of a device that nobody hosts.
     *
     * @throws UnreadableException as {@link DeviceVersion#read}, and where {@code period} is no duration
     */
    public static WantedDevice read(byte[] value) throws UnreadableException {
        DeviceVersion version = DeviceVersion.read(value);
        JsonNode json = NgsiJson.read(value);
        return new WantedDevice(
                version,
                json.path("type").textValue(),
                json.path("device").textValue(),
                !"stopped".equals(json.path("wanted").textValue()),
                period(json.path("period").textValue()),
                json.path(SETTINGS) instanceof ObjectNode settings ? settings : JsonNodeFactory.instance.objectNode());
    }

    private static Duration period(String iso) throws UnreadableException {
        try {
            return iso == null ? null : Duration.parse(iso);
        } catch (DateTimeException e) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, "'period' of the device is no duration", e);
        }
    }

    public byte[] toBytes() {
        ObjectNode json = version.toJson();
        if (isHosted()) {
            json.put("type", type).put("device", device);
        }
        json.put("wanted", running ? "running" : "stopped");
        if (period != null) {
            json.put("period", period.toString());
        }
        if (!settings.isEmpty()) {
            json.set(SETTINGS, settings);
        }
        return NgsiJson.write(json);
    }
}
