package io.furrow.model.device;

import java.time.DateTimeException;
import java.time.Duration;
import java.util.List;
import java.util.Objects;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.control.MeasuredAttribute;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * A record of {@code service.devices} as the control plane writes it: to which mission the device belongs, which is all
 * that jobs read, how it is provisioned, and whether a host simulates it. The host reconciles its devices with these
 * records and reports on {@code service.devices.status}, see {@link DeviceStatus}.
 *
 * @param type of the entity; null if the device has credentials of its own and is not provisioned
 * @param device id at the IoT Agent and in MQTT topics; null if {@code type} is
 * @param running false to remove the device; {@code version} then has an end
 * @param period between two measures; null if unknown
 * @param simulated whether a host runs it; a real device is up with its first report
 * @param settings {@code area}, {@code path}, {@code speed}, {@code faults}, {@code parameters}, if the record itself
 * contains them; owned by the record
 * @param group reference to them, see {@link MissionDeviceLists#resolve}; null if the record itself contains them
 * @param generation number of rotations of its credentials, see {@link FarmSecret#device(String, String, int)}
 */
public record DesiredDevice(
        DeviceVersion version,
        String type,
        String device,
        boolean running,
        Duration period,
        boolean simulated,
        ObjectNode settings,
        GroupRef group,
        int generation) {
    /** The type of robots, whatever the type that their entities report. */
    public static final String ROBOT = "Robot";

    private static final String SETTINGS = "settings";
    private static final String GROUP = "group";
    private static final String SIMULATED = "simulated";
    private static final String GENERATION = "generation";

    public DesiredDevice {
        Objects.requireNonNull(version);
        Objects.requireNonNull(settings);
    }

    /** Returns a device, simulated if it has a type, with its settings and without rotated credentials. */
    public static DesiredDevice simulated(
            DeviceVersion version, String type, String device, boolean running, Duration period, ObjectNode settings) {
        return new DesiredDevice(version, type, device, running, period, type != null, settings, null, 0);
    }

    /** Returns the device with these settings. */
    DesiredDevice with(ObjectNode own) {
        return new DesiredDevice(version, type, device, running, period, simulated, own, null, generation);
    }

    public DesiredDevice withGeneration(int other) {
        return new DesiredDevice(version, type, device, running, period, simulated, settings, group, other);
    }

    public boolean isRobot() {
        return ROBOT.equals(type);
    }

    /** Returns the {@code {latitude, longitude}} of a real device that does not report them; otherwise null. */
    public JsonNode place() {
        JsonNode at = settings.path("at");
        return at.isObject() && !simulated ? at : null;
    }

    /** Returns its attributes, see {@link MeasuredAttribute#of}; requires checked settings in the record. */
    public List<MeasuredAttribute> attributes() {
        return MeasuredAttribute.of(type, simulated, settings.path("attributes"), place() != null);
    }

    /** Returns the device with another version. */
    public DesiredDevice with(DeviceVersion other, boolean shallRun) {
        return new DesiredDevice(other, type, device, shallRun, period, simulated, settings, group, generation);
    }

    /**
     * Reads the value of a record; one with only a version is a device that is not provisioned.
     *
     * @throws UnreadableException as {@link DeviceVersion#read}, and if {@code period} is not a duration or {@code
     * generation} is not a whole number from 0
     */
    public static DesiredDevice read(byte[] value) throws UnreadableException {
        DeviceVersion version = DeviceVersion.read(value);
        JsonNode json = NgsiJson.read(value);
        return new DesiredDevice(
                version,
                json.path("type").textValue(),
                json.path("device").textValue(),
                !"stopped".equals(json.path("wanted").textValue()),
                period(json.path("period").textValue()),
                json.path(SIMULATED).asBoolean(),
                json.path(SETTINGS) instanceof ObjectNode settings ? settings : NgsiJson.object(),
                GroupRef.read(json.path(GROUP)),
                generation(json.path(GENERATION)));
    }

    private static int generation(JsonNode number) throws UnreadableException {
        if (number.isMissingNode()) {
            return 0;
        }
        Reason.NOT_AN_EVENT.refuseIf(
                !number.isIntegralNumber() || !number.canConvertToInt() || number.intValue() < 0,
                "'generation' of the device is not a whole number from 0 on");
        return number.intValue();
    }

    private static Duration period(String iso) throws UnreadableException {
        try {
            return iso == null ? null : Duration.parse(iso);
        } catch (DateTimeException e) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, "'period' of the device is not a duration", e);
        }
    }

    public byte[] toBytes() {
        ObjectNode json = StateJson.tree(version);
        if (type != null) {
            json.put("type", type).put("device", device).put(SIMULATED, simulated);
        }
        json.put("wanted", running ? "running" : "stopped");
        if (period != null) {
            json.put("period", period.toString());
        }
        if (!settings.isEmpty()) {
            json.set(SETTINGS, settings);
        }
        if (group != null) {
            json.set(GROUP, StateJson.tree(group));
        }
        if (generation > 0) {
            json.put(GENERATION, generation);
        }
        return NgsiJson.write(json);
    }
}
