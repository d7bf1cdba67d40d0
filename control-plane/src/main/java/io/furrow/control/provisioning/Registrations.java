package io.furrow.control.provisioning;

import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.control.provisioning.Registration.Attribute;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.device.WantedDevice;

/**
 * What the IoT Agent shall know of wanted devices. The attributes of a device follow from its type, or are those of the member
 * {@code attributes} of its {@code parameters}: objects with {@code object_id}, {@code name} and {@code type}.
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

    private final FarmSecret secret;

    Registrations(FarmSecret secret) {
        this.secret = secret;
    }

    /** Whether a device is provisioned at all: robots write to the context broker by themselves. */
    static boolean isProvisioned(WantedDevice wanted) {
        return wanted.isHosted() && wanted.running() && !ROBOT.equals(wanted.type());
    }

    /** Whether what the agent has was made here: nobody else comes to the mission's API key. */
    boolean isOurs(String apiKey, String mission) {
        return mission != null && secret.apiKey(mission).equals(apiKey);
    }

    /** @throws RefusedByAgentException naming the member of {@code parameters} that is wrong */
    Registration of(WantedDevice wanted) throws RefusedByAgentException {
        DeviceVersion version = wanted.version();
        Set<Attribute> attributes = new LinkedHashSet<>(measured(wanted));
        attributes.addAll(COMMON);
        return new Registration(
                wanted.device(),
                secret.apiKey(version.mission()),
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
