package io.furrow.simulators.scenario;

import java.time.Instant;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.simulators.robot.WorkField;
import io.furrow.simulators.scenario.SimulatedDevice.Camera;
import io.furrow.simulators.scenario.SimulatedDevice.Place;
import io.furrow.simulators.scenario.SimulatedDevice.Robot;
import io.furrow.simulators.scenario.SimulatedDevice.Sensor;

/** Reads a whole scenario and checks across devices: duplicate ids, missing carriers. */
final class FarmReader {
    private static final Pattern NAME = Pattern.compile("[A-Za-z0-9_-]{1,64}");

    private final Instant start;
    private final Map<String, String> ids = new LinkedHashMap<>();
    private final Map<String, String> entities = new LinkedHashMap<>();
    private final Map<String, String> robots = new LinkedHashMap<>();

    FarmReader(Instant start) {
        this.start = start;
    }

    Farm farm(ScenarioObjectReader file) throws InvalidScenarioException {
        PlaceReader places = new PlaceReader(fields(file));
        GroupReader groups = new GroupReader(places, new FaultReader(start), file.whole("seed", 0, Long.MAX_VALUE, 0));
        String apiKey = name(file, "apiKey");
        List<SimulatedDevice> devices = new ArrayList<>();
        for (ScenarioObjectReader mission : file.objects("missions")) {
            List<SimulatedDevice> loose = new ArrayList<>();
            Map<SimulatedDevice, ScenarioObjectReader> from = new LinkedHashMap<>();
            String domain = name(mission, "domain");
            String named = name(mission, "mission");
            for (ScenarioObjectReader group : mission.objects("devices")) {
                for (SimulatedDevice device : groups.devices(group, domain, named)) {
                    register(device, group);
                    loose.add(device);
                    from.put(device, group);
                }
            }
            mission.end();
            for (SimulatedDevice device : loose) {
                devices.add(carried(device, from.get(device)));
            }
        }
        file.end();
        return new Farm(apiKey, List.copyOf(devices));
    }

    private static Map<String, WorkField> fields(ScenarioObjectReader file) throws InvalidScenarioException {
        Map<String, WorkField> fields = new LinkedHashMap<>();
        if (!file.has("fields")) {
            return fields;
        }
        int number = 0;
        for (JsonNode feature : file.object("fields").node("features")) {
            String at = "fields.features[" + number++ + "]";
            try {
                WorkField field = WorkField.of(feature);
                if (fields.put(field.id(), field) != null) {
                    throw new InvalidScenarioException(at, "field '" + field.id() + "' is defined twice");
                }
            } catch (IllegalArgumentException e) {
                throw new InvalidScenarioException(at, e.getMessage(), e);
            }
        }
        return fields;
    }

    private static String name(ScenarioObjectReader json, String member) throws InvalidScenarioException {
        String name = json.text(member);
        if (!NAME.matcher(name).matches()) {
            throw json.refused(member, "must be 1 to 64 of A-Z a-z 0-9 _ -, not '" + name + "'");
        }
        return name;
    }

    private void register(SimulatedDevice device, ScenarioObjectReader group) throws InvalidScenarioException {
        if (!NAME.matcher(device.id()).matches()) {
            throw group.refused("id", "must be 1 to 64 of A-Z a-z 0-9 _ -, not '" + device.id() + "'");
        }
        free(ids, device.id(), group, "id");
        free(entities, device.identity().entity(), group, "entity");
        if (device instanceof Robot) {
            robots.put(device.id(), device.identity().mission());
        }
    }

    private static void free(Map<String, String> taken, String value, ScenarioObjectReader group, String member)
            throws InvalidScenarioException {
        String by = taken.put(value, group.path());
        if (by != null) {
            throw group.refused(member, "'%s' is taken by %s; give it another".formatted(value, by));
        }
    }

    /** Resolves the carrier: the robot of the same number, or the one robot that carries the whole group. */
    private SimulatedDevice carried(SimulatedDevice device, ScenarioObjectReader group)
            throws InvalidScenarioException {
        if (device instanceof Sensor sensor && sensor.place().carrier() != null) {
            return new Sensor(
                    sensor.identity(), sensor.period(), found(sensor.place(), device, group), sensor.quantities());
        }
        if (device instanceof Camera camera && camera.place().carrier() != null) {
            return new Camera(
                    camera.identity(),
                    camera.period(),
                    found(camera.place(), device, group),
                    camera.heading(),
                    camera.silent(),
                    camera.battery());
        }
        return device;
    }

    private Place found(Place place, SimulatedDevice device, ScenarioObjectReader group)
            throws InvalidScenarioException {
        String carriedBy = group.text("carriedBy");
        for (String carrier : List.of(place.carrier(), carriedBy)) {
            if (device.identity().mission().equals(robots.get(carrier))) {
                return new Place(place.where(), null, carrier);
            }
        }
        throw group.refused(
                "carriedBy",
                "there is no robot '%s' in mission '%s'; a carrier is a robot of the same mission"
                        .formatted(place.carrier(), device.identity().mission()));
    }
}
