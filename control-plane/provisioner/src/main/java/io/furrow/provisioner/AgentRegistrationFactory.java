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
 * The desired registrations of devices at the IoT Agent. What a device sends becomes attributes as {@link MeasuredAttribute} says; its
 * place, if its group has one, is a static attribute.
 */
final class AgentRegistrationFactory {
    private static final String ROBOT = "Robot";
    private static final Set<String> COMMANDS = new LinkedHashSet<>(List.of("on", "off", "restart"));

    private final Supplier<FarmSecret> secret;

    AgentRegistrationFactory(Supplier<FarmSecret> secret) {
        this.secret = secret;
    }

    /** Whether a device is provisioned at all: simulated robots write to the context broker by themselves. */
    static boolean isProvisioned(DesiredDevice desired) {
        return desired.type() != null && desired.running() && !(desired.simulated() && ROBOT.equals(desired.type()));
    }

    /** Whether what the agent has was made here, maybe before a rotation: nobody else comes to the mission's API key. */
    boolean isOurs(String apiKey, String mission) {
        return mission != null && secret.get().madeApiKey(apiKey, mission);
    }

    /**
     * Whether the agent can keep devices of a scope. It wants a tenant with every request; with an empty one it does not find the
     * device of a command, which the context broker sends it without.
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
