package io.furrow.cli.control.table;

import java.time.Instant;
import java.util.List;
import java.util.StringJoiner;

import com.fasterxml.jackson.databind.JsonNode;

/** Prints an alarm as lines {@code label: value}: what it is about, since when, and what was done about it. */
public final class AlarmPage {
    private AlarmPage() {}

    /** @param alarm as the REST API has it */
    public static List<String> of(JsonNode alarm, Instant now) {
        PageLines page = new PageLines(now);
        page.add(
                "Alarm",
                alarm.path("alarm").asText() + ", " + alarm.path("severity").asText());
        page.add("Text", alarm.path("text").asText());
        page.add("State", alarm.path("state").asText() + PageLines.reason(alarm.path("reason")));
        page.add(
                "About",
                alarm.path("kind").asText() + " of " + alarm.path("subject").asText());
        text(page, "Group", alarm.path("group"));
        StringJoiner devices = new StringJoiner(", ").setEmptyValue("");
        alarm.path("devices").forEach(device -> devices.add(device.path("id").asText()));
        if (devices.length() > 0) {
            page.add("Devices", devices.toString());
        }
        time(page, "Raised", alarm.path("raised"));
        time(page, "Changed", alarm.path("changed"));
        time(page, "Seen", alarm.path("seen"));
        text(page, "Times seen", alarm.path("count"));
        time(page, "Ends by itself", alarm.path("until"));
        time(page, "Muted until", alarm.path("mutedUntil"));
        text(page, "Inhibited by", alarm.path("inhibitedBy"));
        if (alarm.hasNonNull("acknowledgedBy")) {
            page.add("Acknowledged", "by " + alarm.path("acknowledgedBy").asText());
        }
        return page.all();
    }

    private static void text(PageLines page, String label, JsonNode text) {
        if (text.isValueNode() && !text.isNull()) {
            page.add(label, text.asText());
        }
    }

    private static void time(PageLines page, String label, JsonNode time) {
        if (time.isNumber()) {
            page.add(label, page.ago(time));
        }
    }
}
