package io.furrow.provisioner;

import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;
import java.util.function.Supplier;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.control.MeasuredAttribute;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.event.FiwareScope;

/**
 * Creates the desired registrations of devices at the IoT Agent. {@link MeasuredAttribute} maps measures to attributes;
 * the place, if the group of the device has one, is a static attribute.
 */
final class AgentRegistrationFactory {
    private static final Set<String> COMMANDS = new LinkedHashSet<>(List.of("on", "off", "restart"));

    private final Supplier<FarmSecret> secret;

    AgentRegistrationFactory(Supplier<FarmSecret> secret) {
        this.secret = secret;
    }

    /** Whether a device is provisioned: simulated robots are not, because they write to the context broker directly. */
    static boolean isProvisioned(DesiredDevice desired) {
        return desired.type() != null && desired.running() && !(desired.simulated() && desired.isRobot());
    }

    /** Whether an API key was derived from the farm's secret, possibly before a rotation. */
    boolean isOurs(String apiKey, String mission) {
        return mission != null && secret.get().madeApiKey(apiKey, mission);
    }

    /**
     * Whether the agent supports devices of a scope. Every request to it needs a tenant, and the agent would not find
     * the device of a command, because the context broker omits the header for the default tenant.
     */
    static boolean hasTenant(FiwareScope scope) {
        return !scope.service().isEmpty();
    }

    /** @throws RejectedByAgentException if the tenant is missing */
    AgentRegistration of(DesiredDevice desired) throws RejectedByAgentException {
        DeviceVersion version = desired.version();
        if (!hasTenant(DesiredDeviceTable.scope(desired))) {
            throw new RejectedByAgentException(
                    "it belongs to the default tenant, but the IoT Agent needs a tenant; name one with --fiware-service and start its mission again");
        }
        return new AgentRegistration(
                desired.device(),
                secret.get().apiKey(version.mission()),
                version.id(),
                desired.type(),
                new LinkedHashSet<>(desired.attributes()),
                new AgentRegistration.StaticAttribute(version.domain(), version.mission(), place(desired)),
                COMMANDS);
    }

    private static AgentRegistration.Place place(DesiredDevice desired) {
        JsonNode at = desired.place();
        return at == null
                ? null
                : new AgentRegistration.Place(
                        at.path("latitude").doubleValue(), at.path("longitude").doubleValue());
    }
}
