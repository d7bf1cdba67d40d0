package io.furrow.provisioner;

import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.function.Supplier;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.device.DeviceVersion;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.device.WantedDevice;
import io.furrow.model.event.FiwareScope;
import io.furrow.provisioner.Registration.Attribute;

/**
 * The desired registrations of devices at the IoT Agent. The attributes of a device follow from its type, or are those
 * of the member {@code attributes} of its {@code parameters}: objects with {@code object_id}, {@code name} and {@code
 * type}.
 */
final class Registrations {
    private static final String ROBOT = "Robot";
    private static final String FLOAT = "Float";
    private static final Set<String> COMMANDS = new LinkedHashSet<>(List.of("on", "off", "restart"));
    private static final List<Attribute> COMMON = List.of(
            new Attribute("stat", "Status", "Boolean"),
            new Attribute("time", "Time", "Integer"),
            new Attribute("lat", "Latitude", FLOAT),
            new Attribute("lon", "Longitude", FLOAT),
            new Attribute("where", "Location", "String"),
            new Attribute("bat", "battery", FLOAT));
    private static final Map<String, List<Attribute>> MEASURED = Map.of(
            "Thermometer", List.of(new Attribute("temp", "Temperature", FLOAT)),
            // The context broker refuses the = of base64 in ordinary text.
            "Camera", List.of(new Attribute("img", "Image", "TextUnrestricted")),
            "WeatherStation",
                    List.of(
                            new Attribute("temp", "Temperature", FLOAT),
                            new Attribute("hum", "Humidity", FLOAT),
                            new Attribute("press", "Pressure", FLOAT),
                            new Attribute("wind", "WindSpeed", FLOAT),
                            new Attribute("dir", "WindDirection", FLOAT),
                            new Attribute("rain", "Rain", FLOAT),
                            new Attribute("sun", "SolarRadiation", FLOAT)));

    private final Supplier<FarmSecret> secret;

    Registrations(Supplier<FarmSecret> secret) {
        this.secret = secret;
    }

    /** Whether a device is provisioned at all: robots write to the context broker by themselves. */
    static boolean isProvisioned(WantedDevice wanted) {
        return wanted.type() != null && wanted.running() && !ROBOT.equals(wanted.type());
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

    /** @throws RefusedByAgentException naming the member of {@code parameters} that is wrong, or a missing tenant */
    Registration of(WantedDevice wanted) throws RefusedByAgentException {
        DeviceVersion version = wanted.version();
        if (!hasTenant(WantedDevices.scope(wanted))) {
            throw new RefusedByAgentException(
                    "it belongs to the default tenant, but the IoT Agent needs a tenant; name one with --fiware-service and start its mission again");
        }
        Set<Attribute> attributes = new LinkedHashSet<>(measured(wanted));
        attributes.addAll(COMMON);
        return new Registration(
                wanted.device(),
                secret.get().apiKey(version.mission()),
                version.id(),
                wanted.type(),
                attributes,
                version.domain(),
                version.mission(),
                COMMANDS);
    }

    private static Set<Attribute> measured(WantedDevice wanted) throws RefusedByAgentException {
        JsonNode own = wanted.settings().at("/parameters/attributes");
        if (own.isMissingNode() || own.isNull()) {
            return new LinkedHashSet<>(MEASURED.getOrDefault(wanted.type(), List.of()));
        }
        Set<Attribute> attributes = new LinkedHashSet<>();
        for (JsonNode each : own) {
            String name = each.path("name").asText();
            attributes.add(new Attribute(
                    each.path("object_id").asText(name), name, each.path("type").asText("Text")));
        }
        boolean nameless = attributes.stream().anyMatch(each -> each.name().isBlank());
        if (!own.isArray() || nameless) {
            throw new RefusedByAgentException(
                    "'attributes' of its parameters is no list of objects with 'object_id', 'name' and 'type'");
        }
        return attributes;
    }
}
