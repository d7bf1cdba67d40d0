package io.furrow.soak.devices;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * The missions, their devices, and the behavior of each device's program. Devices that must not meet are at least 10 m
 * apart.
 */
final class ProgramPlan {
    static final String DOMAIN = "soak";
    static final String FAULTY = "faulty";
    /** A value far from all others, of one thermometer of the mission {@code orchard}. */
    static final double BROKEN = 60;
    /** Number of stored measures that a device sends when it is switched on. */
    static final int STORED = 12;

    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;
    private static final double LATITUDE = 40.3;
    private static final double LONGITUDE = -3.48;
    private static final double FIELDS_APART = 0.01;
    private static final double POSITIONS_APART = 0.00015;
    private static final int POSITIONS_IN_A_ROW = 9;
    private static final double TRACTORS = 40.4;
    private static final double OTHERS = 40.45;
    private static final Map<String, String> NAMES =
            Map.of("Temperature", "temp", "Latitude", "lat", "Longitude", "lon");
    private static final Map<String, String> FOREIGN = Map.of("Temperature", "t", "Latitude", "y", "Longitude", "x");
    private static final String ATTRIBUTES = """
            [{"object_id": "t", "name": "Temperature", "unit": "CEL"}, {"object_id": "m", "name": "Moisture", "unit": "P1"},
             {"object_id": "y", "name": "Latitude"}, {"object_id": "x", "name": "Longitude"}]""";
    private static final int[] CLOCKS_AHEAD_SECONDS = {-7200, -600, 30, 600, 3000};

    private final List<Mission> missions = new ArrayList<>();

    /** @param groups for {@code ./furrow mission start --devices} */
    record Mission(String name, ArrayNode groups, List<Device> devices) {}

    /**
     * One device.
     *
     * @param fault of its program; {@code none} if there is none
     * @param field in which it measures; null if it is in none
     * @param behavior of its program
     */
    record Device(String id, String mission, String fault, String field, Duration period, ObjectNode behavior) {
        boolean isHealthy() {
            return fault.equals("none");
        }

        /** Whether its reports arrive, with a correct or wrong time. */
        boolean reports() {
            return isHealthy() || fault.equals("clock");
        }

        boolean isTractor() {
            return mission.equals("tractors");
        }
    }

    /** Common properties of devices. */
    private record Group(
            String mission, String type, int count, String period, String fault, int field, Map<String, String> names) {
        static Group of(String mission, String type, int count, String period, int field) {
            return new Group(mission, type, count, period, "none", field, NAMES);
        }

        static Group faulty(String type, String fault) {
            return new Group(FAULTY, type, 5, "PT5S", fault, -1, type.equals("SoilProbe") ? FOREIGN : NAMES);
        }

        Duration every() {
            return Duration.parse(period);
        }

        /** Whether the mission sets the positions of its devices. */
        boolean isWithoutGps() {
            return mission.equals("barns");
        }
    }

    ProgramPlan() {
        start(Group.of("rows", "Thermometer", 25, "PT1S", 0));
        start(Group.of("orchard", "Thermometer", 35, "PT5S", 1));
        start(new Group("probes", "SoilProbe", 20, "PT10S", "none", 2, FOREIGN));
        start(Group.of("barns", "Thermometer", 10, "PT5S", 3));
        start(Group.of("tractors", "Tractor", 10, "PT1S", -1));
        start(Group.of("half-minute", "Thermometer", 10, "PT30S", 4));
        start(Group.of("minute", "Thermometer", 20, "PT1M", 4));
        start(Group.of("five-minutes", "Thermometer", 25, "PT5M", 4));
        start(Group.of("quarter-hour", "Thermometer", 25, "PT15M", 4));
        start(
                Group.faulty("Thermometer", "password"),
                Group.faulty("WeatherStation", "topic"),
                Group.faulty("SoilProbe", "json"),
                Group.faulty("Barometer", "clock"));
    }

    List<Mission> missions() {
        return missions;
    }

    List<Device> devices() {
        return missions.stream().flatMap(mission -> mission.devices().stream()).toList();
    }

    /** The fields as GeoJSON, 220 m by 250 m each. */
    ObjectNode fields() {
        ObjectNode all = NODES.objectNode().put("type", "FeatureCollection");
        ArrayNode features = all.putArray("features");
        for (int field = 0; field <= 4; field++) {
            double south = LATITUDE + field * FIELDS_APART - 0.0003;
            double west = LONGITUDE - 0.0003;
            ObjectNode feature = features.addObject().put("type", "Feature").put("id", name(field));
            feature.putObject("properties").put("Domain", DOMAIN);
            ArrayNode ring = feature.putObject("geometry")
                    .put("type", "Polygon")
                    .putArray("coordinates")
                    .addArray();
            for (int[] corner : new int[][] {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}) {
                ring.addArray().add(west + corner[0] * 0.003).add(south + corner[1] * 0.002);
            }
        }
        return all;
    }

    private static String name(int field) {
        return field < 0 ? null : "field-" + field;
    }

    private void start(Group... groups) {
        String mission = groups[0].mission();
        ArrayNode lists = NODES.arrayNode();
        List<Device> devices = new ArrayList<>();
        for (Group group : groups) {
            ObjectNode list = lists.addObject()
                    .put("type", group.type())
                    .put("count", group.count())
                    .put("period", group.period());
            if (group.names().equals(FOREIGN)) {
                list.set("attributes", JsonReader.read(ATTRIBUTES));
            }
            ArrayNode positions = group.isWithoutGps() ? list.putArray("at") : NODES.arrayNode();
            for (int number = 1; number <= group.count(); number++) {
                double[] position = position(group, devices.size());
                devices.add(device(group, number, position));
                positions.addObject().put("latitude", position[0]).put("longitude", position[1]);
            }
        }
        missions.add(new Mission(mission, lists, devices));
    }

    private double[] position(Group group, int index) {
        if (group.mission().equals("tractors")) {
            return new double[] {TRACTORS + index / 2 * 0.002, LONGITUDE};
        }
        if (group.field() < 0) {
            return new double[] {OTHERS + index * 0.0005, LONGITUDE};
        }
        long existing = devices().stream()
                .filter(each -> name(group.field()).equals(each.field()))
                .count();
        int number = (int) existing + index;
        return new double[] {
            LATITUDE + group.field() * FIELDS_APART + number / POSITIONS_IN_A_ROW * POSITIONS_APART,
            LONGITUDE + number % POSITIONS_IN_A_ROW * POSITIONS_APART * 1.3
        };
    }

    private static Device device(Group group, int number, double[] position) {
        String id = "urn:ngsi-ld:%s:%s-%d".formatted(group.type(), group.mission(), number);
        ObjectNode behavior = NODES.objectNode()
                .put("device", id)
                .put("period", group.every().toSeconds())
                .put("fault", group.fault());
        group.names().forEach(behavior.putObject("names")::put);
        if (!group.isWithoutGps()) {
            behavior.putArray("place").add(position[0]).add(position[1]);
        }
        if (group.every().toSeconds() >= 30) {
            behavior.put("stored", STORED);
        }
        if (group.fault().equals("clock")) {
            behavior.put("ahead", CLOCKS_AHEAD_SECONDS[number - 1] * 1000L);
        }
        if (group.mission().equals("tractors")) {
            behavior.set("path", path(number - 1));
        } else {
            boolean broken = group.mission().equals("orchard") && number == group.count();
            behavior.put("value", broken ? BROKEN : 15 + 2 * group.field() + 0.02 * (number % 10));
        }
        return new Device(id, group.mission(), group.fault(), name(group.field()), group.every(), behavior);
    }

    /**
     * The first device of a pair does not move, the second approaches it and leaves again; that of the last pair stays
     * 8 m away.
     */
    private static ObjectNode path(int index) {
        boolean stands = index % 2 == 0;
        boolean meets = index < 8;
        return NODES.objectNode()
                .put("from", stands || meets ? 0 : 8)
                .put("swing", stands ? 0 : 40)
                .put("seconds", 36 + index);
    }

    /** The pairs that meet: their ids, the lesser first. */
    List<String> pairs() {
        var ids = devices().stream().filter(Device::isTractor).map(Device::id).toList();
        List<String> pairs = new ArrayList<>();
        for (int i = 0; i < 8; i += 2) {
            pairs.add(pair(ids.get(i), ids.get(i + 1)));
        }
        return pairs;
    }

    static String pair(String one, String other) {
        return one.compareTo(other) < 0
                ? String.format(Locale.ROOT, "%s and %s", one, other)
                : String.format(Locale.ROOT, "%s and %s", other, one);
    }
}
