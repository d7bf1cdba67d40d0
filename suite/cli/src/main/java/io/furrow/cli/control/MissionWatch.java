package io.furrow.cli.control;

import java.io.IOException;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.time.Times;
import io.furrow.model.ngsi.NgsiJson;

/** Follows a mission: prints a line for every change of its state, its progress or its missing devices. */
final class MissionWatch implements ControlOptions.Work {
    private static final long POLL_INTERVAL_MILLIS = 300;
    private static final int BAR = 20;

    private final ControlOptions control;
    private final String path;
    private final String until;
    private boolean reached;

    /** @param until the state at which it ends; it also ends when that cannot be reached any more */
    MissionWatch(ControlOptions control, String path, String until) {
        this.control = control;
        this.path = path;
        this.until = until;
    }

    boolean isReached() {
        return reached;
    }

    @Override
    public void with(ControlApi api) throws IOException {
        String shown = "";
        String state;
        do {
            JsonNode mission = api.get(path);
            JsonNode status = mission.path("status");
            state = status.path("state").asText();
            String line =
                    control.isForPeople() ? line(status) : NgsiJson.mapper().writeValueAsString(mission);
            if (!line.equals(shown)) {
                control.out().println(line);
                control.out().flush();
                shown = line;
            }
        } while (!isOver(state) && ReplayWatch.pause(POLL_INTERVAL_MILLIS));
        reached = state.equals(until);
    }

    private boolean isOver(String state) {
        return state.equals(until) || state.equals("failed") || state.equals("stopped");
    }

    private static String line(JsonNode status) {
        int devices = status.path("devices").asInt();
        int confirmed = status.path("confirmed").asInt();
        int full = devices == 0 ? 0 : BAR * confirmed / devices;
        StringBuilder line = new StringBuilder("%s  %-8s  [%s%s] %d/%d devices"
                .formatted(
                        Times.of(status.path("since").asLong()),
                        status.path("state").asText(),
                        "#".repeat(full),
                        "·".repeat(BAR - full),
                        confirmed,
                        devices));
        if (status.hasNonNull("reason")) {
            line.append("  ")
                    .append(ControlTable.printable(status.path("reason").asText()));
        }
        for (JsonNode missing : status.path("missing")) {
            line.append(System.lineSeparator())
                    .append("    missing: ")
                    .append(ControlTable.printable(missing.path("id").asText()
                            + (missing.hasNonNull("reason")
                                    ? ", " + missing.path("reason").asText()
                                    : "")));
        }
        return line.toString();
    }
}
