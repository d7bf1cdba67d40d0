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
 * The farm's fields, changed through the REST API in the morning, before a device reports: one is where the first thermometers
 * stand, moves away for three days of a week and comes back under another name; another is there in the first three days and ends.
 */
final class Plots {
    private static final String HOME = "home";
    private static final double AWAY_LATITUDE = 40.5;
    private static final int MOVES = 2;
    private static final int ENDS = 4;
    private static final int RETURNS = 5;

    private final YearFarm farm;
    /** From when on which field is where the thermometers of a mission stand; an empty text for none. */
    private final Map<Integer, ConcurrentSkipListMap<Long, String>> where = new TreeMap<>();
    /** Latitude and name of each as they are now. */
    private final Map<String, String> now = new TreeMap<>();

    Plots(YearFarm farm) {
        this.farm = farm;
        for (int mission = 1; mission < YearFleet.MISSIONS; mission++) {
            where.put(mission, new ConcurrentSkipListMap<>());
        }
    }

    /** Before the first week. */
    void start() {
        put(HOME, "Home", YearFleet.latitude(1));
        where.get(1).put(0L, HOME);
    }

    void change(int week, int day) {
        String season = "season-" + week;
        long time = System.currentTimeMillis();
        switch (day) {
            case 1 -> {
                put(season, season, YearFleet.latitude(2));
                where.get(2).put(time, season);
            }
            case MOVES -> {
                put(HOME, "Lent", AWAY_LATITUDE);
                where.get(1).put(time, "");
            }
            case ENDS -> {
                farm.request(
                        "PATCH",
                        "/api/fields/" + season,
                        JsonNodeFactory.instance
                                .objectNode()
                                .put("validTo", Instant.ofEpochMilli(time).toString()));
                now.remove(season);
                where.get(2).put(time, "");
            }
            case RETURNS -> {
                put(HOME, "Home " + week, YearFleet.latitude(1));
                where.get(1).put(time, HOME);
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
        now.put(id, shown(name, latitude - 0.001));
    }

    private static String shown(String name, double south) {
        return String.format(java.util.Locale.ROOT, "%s from %.4f on", name, south);
    }

    /** In which field a thermometer stood when it reported; null for none. */
    String fieldOf(ProgramEvent event) {
        Map.Entry<Long, String> field =
                where.get(YearFleet.missionOf(event.device())).floorEntry(event.time());
        return field == null || field.getValue().isEmpty() ? null : field.getValue();
    }

    /** The REST API has the fields of now. */
    YearCheck shown(String when) {
        Map<String, String> found = new TreeMap<>();
        for (JsonNode each :
                farm.up.get("/api/fields?domain=" + FarmYear.DOMAIN).path("features")) {
            double south = south(each.at("/geometry/coordinates/0"));
            found.put(
                    each.path("id").asText(), shown(each.at("/properties/name").asText(), south));
        }
        return new YearCheck(
                "fields, " + when, String.join(", ", List.copyOf(found.values())), YearCheck.differences(now, found));
    }

    private static double south(JsonNode ring) {
        double south = Double.MAX_VALUE;
        for (JsonNode corner : ring) {
            south = Math.min(south, corner.path(1).asDouble());
        }
        return south;
    }
}
