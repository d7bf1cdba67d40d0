package io.furrow.provisioner;

import java.time.Duration;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.event.FiwareScope;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Creates desired devices. */
public final class DesiredDeviceFixture {
    public static final FarmSecret SECRET = new FarmSecret("sixteen bytes or more".getBytes(UTF_8));
    static final FiwareScope SCOPE = new FiwareScope("farm", "/");

    private DesiredDeviceFixture() {}

    static DesiredDevice thermometer(String mission, int number) {
        return device("Thermometer", mission, "urn:ngsi-ld:Thermometer:%s-%d".formatted(mission, number), 1);
    }

    static DesiredDevice device(String type, String mission, String id, long sequence) {
        return device(type, mission, id, sequence, JsonNodeFactory.instance.objectNode());
    }

    static DesiredDevice device(String type, String mission, String id, long sequence, ObjectNode settings) {
        DeviceVersion version =
                new DeviceVersion(id, SCOPE.service(), SCOPE.servicePath(), "north", mission, 0, null, sequence, null);
        return DesiredDevice.simulated(version, type, id, true, Duration.ofSeconds(1), settings);
    }

    static DesiredDevice stopped(DesiredDevice device) {
        DeviceVersion old = device.version();
        DeviceVersion version = new DeviceVersion(
                old.id(),
                old.service(),
                old.servicePath(),
                old.domain(),
                old.mission(),
                0,
                1L,
                old.sequence() + 1,
                null);
        return DesiredDevice.simulated(
                version, device.type(), device.device(), false, device.period(), device.settings());
    }
}
