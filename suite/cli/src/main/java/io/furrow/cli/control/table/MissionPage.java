package io.furrow.cli.control.table;

import java.time.Instant;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.text.Counts;

/** Prints a mission as lines {@code label: value}: its state, its missing devices and why, and its parts. */
public final class MissionPage {
    private final JsonNode mission;
    private final JsonNode status;
    private final PageLines page;

    private MissionPage(JsonNode mission, Instant now) {
        this.mission = mission;
        this.status = mission.path("status");
        this.page = new PageLines(now);
    }

    /** @param mission as the REST API has it */
    public static List<String> of(JsonNode mission, Instant now) {
        return new MissionPage(mission, now).all();
    }

    private List<String> all() {
        page.add(
                "Mission",
                mission.path("mission").asText() + " of domain "
                        + mission.path("domain").asText());
        if (mission.hasNonNull("template")) {
            page.add("Template", mission.path("template").asText());
        }
        String since = status.has("since") ? " since " + page.ago(status.path("since")) : "";
        page.add("State", status.path("state").asText("not known") + since + PageLines.reason(status.path("reason")));
        switch (status.path("state").asText()) {
            case "starting", "running" -> devices("up");
            case "stopping" -> devices("stopped");
            default -> {} // the counts are those of a stop, or of none
        }
        for (JsonNode missing : status.path("missing")) {
            page.add("Missing", missing.path("id").asText() + PageLines.reason(missing.path("reason")));
        }
        time("Start", mission.path("start"));
        time("Due", status.path("due"));
        time("End", status.path("ends"));
        mission.path("devices").forEach(this::group);
        time("Created", mission.path("created"));
        return page.all();
    }

    private void devices(String as) {
        page.add(
                "Devices",
                "%d of %d are %s"
                        .formatted(
                                status.path("confirmed").asInt(),
                                status.path("devices").asInt(),
                                as));
    }

    private void time(String label, JsonNode time) {
        if (time.isNumber()) {
            page.add(label, page.ago(time));
        }
    }

    private void group(JsonNode group) {
        if (group.isTextual()) {
            page.add("Group", group.textValue() + ", which has a login of its own");
            return;
        }
        StringBuilder text = new StringBuilder(
                group.hasNonNull("id")
                        ? group.path("id").asText()
                        : Counts.of(group.path("count").asInt(1), "device"));
        text.append(" of type ").append(group.path("type").asText("not known"));
        text.append(group.path("simulated").booleanValue() ? ", simulated" : ", real");
        for (String setting : List.of("name", "period", "carriedBy")) {
            if (group.hasNonNull(setting)) {
                text.append(", ")
                        .append(setting)
                        .append(' ')
                        .append(group.path(setting).asText());
            }
        }
        page.add("Group", text.toString());
    }
}
