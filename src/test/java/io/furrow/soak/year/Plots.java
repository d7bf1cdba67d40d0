package io.furrow.soak.year;

import java.time.Instant;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.concurrent.ConcurrentSkipListMap;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.soak.devices.ProgramEvent;

/**
 * Changes the farm's fields through the REST API in the morning, before devices report: the field of the first
 * mission's thermometers moves away for three days of a week and returns under another name; another field exists in
 * the first three days.
 */
final class Plots {
    private static final String HOME = "home";
    private static final double AWAY_LATITUDE = 40.5;
    private static final int MOVES = 2;
    private static final int ENDS = 4;
    private static final int RETURNS = 5;

    private final YearFarm farm;
    /** The field of each mission's thermometers by start time; empty for none. */
    private final Map<Integer, ConcurrentSkipListMap<Long, String>> fields = new TreeMap<>();
    /** The current latitude and name of each field. */
    private final Map<String, String> current = new TreeMap<>();

    Plots(YearFarm farm) {
        this.farm = farm;
        for (int mission = 1; mission < YearFleet.MISSIONS; mission++) {
            fields.put(mission, new ConcurrentSkipListMap<>());
        }
    }

    /** Creates the first field before the first week. */
    void start() {
        put(HOME, "Home", YearFleet.latitude(1));
        fields.get(1).put(0L, HOME);
    }

    void change(int week, int day) {
        String season = "season-" + week;
        long time = System.currentTimeMillis();
        switch (day) {
            case 1 -> {
                put(season, season, YearFleet.latitude(2));
                fields.get(2).put(time, season);
            }
            case MOVES -> {
                put(HOME, "Lent", AWAY_LATITUDE);
                fields.get(1).put(time, "");
            }
            case ENDS -> {
                farm.request(
                        "PATCH",
                        "/api/fields/" + season,
                        JsonNodeFactory.instance
                                .objectNode()
                                .put("validTo", Instant.ofEpochMilli(time).toString()));
                current.remove(season);
                fields.get(2).put(time, "");
            }
            case RETURNS -> {
                put(HOME, "Home " + week, YearFleet.latitude(1));
                fields.get(1).put(time, HOME);
            }
            default -> {}
        }
    }

    private void put(String id, String name, double latitude) {
        ObjectNode all = JsonNodeFactory.instance.objectNode().put("type", "FeatureCollection");
        ObjectNode feature =
                all.putArray("features").addObject().put("type", "Feature").put("id", id);
        feature.putObject("properties").put("name", name).put("Domain", FarmYear.DOMAIN);
        ArrayNode ring = feature.putObject("geometry")
                .put("type", "Polygon")
                .putArray("coordinates")
                .addArray();
        for (int[] corner : new int[][] {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}) {
            ring.addArray()
                    .add(YearFleet.LONGITUDE - 0.001 + corner[0] * 0.006)
                    .add(latitude - 0.001 + corner[1] * 0.002);
        }
        farm.request("POST", "/api/fields", all);
        current.put(id, describe(name, latitude - 0.001));
    }

    private static String describe(String name, double south) {
        return String.format(java.util.Locale.ROOT, "%s from %.4f on", name, south);
    }

    /** The field in which a thermometer stood when it reported; null for none. */
    String fieldOf(ProgramEvent event) {
        Map.Entry<Long, String> field =
                fields.get(YearFleet.missionOf(event.device())).floorEntry(event.time());
        return field == null || field.getValue().isEmpty() ? null : field.getValue();
    }

    /** Checks that the REST API returns the current fields. */
    YearCheck check(String when) {
        Map<String, String> found = new TreeMap<>();
        for (JsonNode each :
                farm.up.get("/api/fields?domain=" + FarmYear.DOMAIN).path("features")) {
            double south = south(each.at("/geometry/coordinates/0"));
            found.put(
                    each.path("id").asText(),
                    describe(each.at("/properties/name").asText(), south));
        }
        return new YearCheck(
                "fields, " + when,
                String.join(", ", List.copyOf(found.values())),
                YearCheck.differences(current, found));
    }

    private static double south(JsonNode ring) {
        double south = Double.MAX_VALUE;
        for (JsonNode corner : ring) {
            south = Math.min(south, corner.path(1).asDouble());
        }
        return south;
    }
}
