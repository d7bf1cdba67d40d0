package io.furrow.soak.year;

import java.time.Duration;
import java.util.Map;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.soak.control.Until;

/**
 * Runs a mission in each week with a device that reports once and falls silent, and one that never reports. While the
 * mission runs, the first must have an alarm {@code silent-device}, the second {@code missing-devices}.
 */
record SilentDevices(YearFarm farm, YearFleet fleet) {
    private static final String FALLS_SILENT = "urn:ngsi-ld:Thermometer:falls-silent";
    private static final String NEVER_REPORTS = "urn:ngsi-ld:Thermometer:never-reports";
    private static final Map<String, String> ALARMS =
            Map.of("silent-device", FALLS_SILENT, "missing-devices", NEVER_REPORTS);
    private static final Duration TIMEOUT = Duration.ofSeconds(30);

    private static String mission(int week) {
        return "silent-" + week;
    }

    void begin(int week) {
        ObjectNode plan = JsonNodeFactory.instance.objectNode().put("domain", FarmYear.DOMAIN);
        ArrayNode devices = plan.putArray("devices");
        for (String id : new String[] {FALLS_SILENT, NEVER_REPORTS}) {
            devices.addObject().put("id", id).put("type", "Thermometer").put("period", "PT1S");
        }
        farm.request("POST", "/api/missions/" + mission(week) + "/start", plan);
    }

    /** Reports once, after the mission is known. */
    void report() {
        fleet.reportOnce(FALLS_SILENT);
    }

    void end(int week) {
        farm.request("POST", "/api/missions/" + mission(week) + "/stop", null);
    }

    void delete(int week) {
        farm.delete(mission(week));
    }

    /** Checks that both alarms of this mission are open. */
    YearCheck checkSilent(String when, int week) {
        Until.within(TIMEOUT, () -> open(week).equals(ALARMS));
        return new YearCheck(
                "alarms of silent devices, " + when,
                String.join(", ", open(week).keySet()),
                YearCheck.differences(ALARMS, open(week)));
    }

    YearCheck checkRemoved(String when, int week) {
        Until.within(TIMEOUT, () -> open(week).isEmpty());
        return new YearCheck(
                "no alarm once their mission has ended, " + when, "", YearCheck.differences(Map.of(), open(week)));
    }

    /** Devices with open alarms, by kind of alarm. */
    private Map<String, String> open(int week) {
        Map<String, String> open = new TreeMap<>();
        for (JsonNode alarm : farm.up.get("/api/alarms?limit=10000")) {
            if (!alarm.path("state").asText().equals("closed")
                    && alarm.path("subject").asText().equals("urn:ngsi-ld:Mission:" + mission(week))) {
                open.put(
                        alarm.path("kind").asText(),
                        String.join(", ", alarm.path("devices").findValuesAsText("id")));
            }
        }
        return open;
    }
}
