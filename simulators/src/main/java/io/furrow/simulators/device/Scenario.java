package io.furrow.simulators.device;

import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.util.List;

import io.furrow.model.ngsi.NgsiJson;

/**
 * A farm to simulate: domains, their missions, the devices of each mission. Read from JSON; unknown members are refused.
 *
 * @param apiKey key of the service group at the IoT Agent, first part of every MQTT topic
 */
public record Scenario(String apiKey, List<Domain> domains) {
    /** Three fields with six thermometers (one defective), a camera, two robots that meet, and the domain canary. */
    public static final String DEMO = "/io/furrow/simulators/demo/scenario.json";

    /** The fields of {@link #DEMO}: GeoJSON features with {@code id}, {@code name} and {@code Domain}. */
    public static final String DEMO_FIELDS = "/io/furrow/simulators/demo/fields.geojson";

    public record Domain(String name, List<Mission> missions) {}

    public record Mission(String name, List<DevicePlan> devices) {}

    /** A device and the mission it serves. */
    public record Assignment(String domain, String mission, DevicePlan device) {}

    /**
     * A scenario from its JSON.
     *
     * @throws IOException if it is no scenario; the message names the member
     */
    public static Scenario read(InputStream json) throws IOException {
        return NgsiJson.mapper().readValue(json, Scenario.class);
    }

    /** The scenario that the demo runs. */
    public static Scenario demo() {
        try (InputStream json = Scenario.class.getResourceAsStream(DEMO)) {
            return read(json);
        } catch (IOException e) {
            throw new UncheckedIOException("the packaged scenario " + DEMO + " is unreadable", e);
        }
    }

    /** All devices with their domain and mission, in the order of the file. */
    public List<Assignment> assignments() {
        return domains.stream()
                .flatMap(domain -> domain.missions().stream()
                        .flatMap(mission -> mission.devices().stream()
                                .map(device -> new Assignment(domain.name(), mission.name(), device))))
                .toList();
    }
}
