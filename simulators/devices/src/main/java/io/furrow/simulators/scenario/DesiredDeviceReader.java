package io.furrow.simulators.scenario;

import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.Map;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.device.DesiredDevice;
import io.furrow.simulators.robot.WorkField;
import io.furrow.simulators.scenario.SimulatedDevice.Identity;

/**
 * Creates a simulated device from a desired one: {@code area}, {@code path}, {@code speed}, {@code faults} of its
 * settings, and further members of a scenario device as {@code parameters}. The same record and seed always create the
 * same device.
 */
public final class DesiredDeviceReader {
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;
    private static final Duration PERIOD = Duration.ofSeconds(5);
    private static final Map<String, Duration> PERIODS =
            Map.of(DesiredDevice.ROBOT, Duration.ofSeconds(1), "Camera", Duration.ofSeconds(10));
    private static final List<String> NO_PARAMETERS =
            List.of("type id entity count period area at route path speed faults carriedBy attributes".split(" "));
    private static final Pattern NUMBERED = Pattern.compile(".*-(\\d{1,9})");

    private final PlaceReader places;
    private final long seed;
    /** The last drawn area and its reader: devices of one group are read together and share it. */
    private JsonNode drawnArea;

    private PlaceReader drawnPlaces;

    /** @param fields by id */
    public DesiredDeviceReader(Map<String, WorkField> fields, long seed) {
        this.places = new PlaceReader(fields);
        this.seed = seed;
    }

    /**
     * Creates the device. Times of its faults and its way count from the start of the desired record.
     *
     * @throws InvalidScenarioException naming the setting, the mistake and the remedy
     */
    public SimulatedDevice read(DesiredDevice desired) throws InvalidScenarioException {
        Identity identity = new Identity(
                desired.device(),
                desired.version().id(),
                desired.type(),
                desired.version().domain(),
                desired.version().mission(),
                desired.generation());
        ObjectNode entry = parameters(desired.settings());
        Duration period = desired.period() == null ? PERIODS.getOrDefault(desired.type(), PERIOD) : desired.period();
        entry.put("period", period.toString());
        if (desired.settings().has("faults")) {
            entry.set("faults", desired.settings().get("faults"));
        }
        if (!GroupReader.TYPES.contains(desired.type()) && desired.settings().has("attributes")) {
            ArrayNode attributes = entry.putArray("attributes");
            desired.settings()
                    .get("attributes")
                    .forEach(each ->
                            attributes.add(((ObjectNode) each).deepCopy().without("unit")));
        }
        PlaceReader where = place(desired, entry);
        FaultReader faults =
                new FaultReader(Instant.ofEpochMilli(desired.version().from()));
        return new GroupReader(where, faults, seed)
                .single(ScenarioObjectReader.of(entry, ""), identity, number(identity.entity()));
    }

    private static ObjectNode parameters(ObjectNode settings) throws InvalidScenarioException {
        ObjectNode entry = NODES.objectNode();
        if (settings.get("parameters") instanceof ObjectNode parameters) {
            for (String name : NO_PARAMETERS) {
                if (parameters.has(name)) {
                    throw new InvalidScenarioException(
                            "parameters." + name, "is not a parameter; say it of the device itself");
                }
            }
            entry.setAll(parameters.deepCopy());
        }
        return entry;
    }

    /** Writes the place of the device into its entry; returns the reader with the fields named there. */
    private PlaceReader place(DesiredDevice desired, ObjectNode entry) throws InvalidScenarioException {
        ObjectNode settings = desired.settings();
        String carrier = desired.version().carriedBy();
        boolean robot = desired.isRobot();
        if (robot && carrier != null) {
            throw new InvalidScenarioException("carriedBy", "a robot goes by itself; leave it out");
        }
        if (carrier != null) {
            entry.put("carriedBy", deviceOf(carrier));
            return places;
        }
        if (settings.has("path")) {
            entry.set("route", route(settings.get("path")));
            if (settings.has("speed")) {
                entry.set("speed", settings.get("speed"));
            }
            return places;
        }
        if (settings.path("at").isObject()) {
            entry.putArray("route").add(settings.get("at"));
            return places;
        }
        if (!settings.has("area")) {
            throw new InvalidScenarioException(
                    "area",
                    robot
                            ? "is missing; a robot needs an area, which it works row by row, or a path"
                            : "is missing; say where it is with one of at, area, path or carriedBy");
        }
        return area(settings, entry, robot);
    }

    private PlaceReader area(ObjectNode settings, ObjectNode entry, boolean robot) throws InvalidScenarioException {
        JsonNode area = settings.get("area");
        String field = area.isObject() ? "area" : area.asText();
        if (robot) {
            if (!entry.path("rows").isObject()) {
                entry.putObject("rows");
            }
            ((ObjectNode) entry.get("rows")).put("field", field);
            if (settings.has("speed")) {
                entry.set("speed", settings.get("speed"));
            }
        } else {
            entry.put("area", field);
        }
        return area.isObject() ? drawnPlaces((ObjectNode) area) : places;
    }

    private PlaceReader drawnPlaces(ObjectNode area) throws InvalidScenarioException {
        if (area != drawnArea) {
            drawnPlaces = new PlaceReader(Map.of("area", drawn(area)));
            drawnArea = area;
        }
        return drawnPlaces;
    }

    private static WorkField drawn(ObjectNode area) throws InvalidScenarioException {
        try {
            return WorkField.largestOf("area", area);
        } catch (IllegalArgumentException e) {
            throw new InvalidScenarioException("area", e.getMessage(), e);
        }
    }

    private static ArrayNode route(JsonNode path) throws InvalidScenarioException {
        if (path.isEmpty()) {
            throw new InvalidScenarioException("path", "has no point; give at least one [longitude, latitude]");
        }
        ArrayNode route = NODES.arrayNode();
        for (JsonNode point : path) {
            ObjectNode place = route.addObject();
            place.set("longitude", point.path(0));
            place.set("latitude", point.path(1));
        }
        return route;
    }

    /** The device id that the control plane derives from an entity id. */
    private static String deviceOf(String entity) {
        return entity.replace("+", "%2B");
    }

    /** The number at the end of an id, 1 without one. */
    private static long number(String entity) {
        Matcher numbered = NUMBERED.matcher(entity);
        return numbered.matches() ? Long.parseLong(numbered.group(1)) : 1;
    }
}
