package io.furrow.cli.control;

import java.io.IOException;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.TimeUnit;

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

    /** While it waits for its start, there is nothing to show. */
    private static final String UNTIL_START =
            "?wait=starting&wait=running&wait=stopping&wait=stopped&wait=failed&timeout=";

    private static final long MAX_WAIT_SECONDS = 30;

    private final ControlOptions control;
    private final String mission;
    private final String until;
    /** In ns; null if it waits for ever. */
    private final Long deadline;
    /** Before each line; null to print none. */
    private final String prefix;

    private String state = "";

    /** @param until the state at which it ends; it also ends when that cannot be reached any more */
    MissionWatch(ControlOptions control, String mission, String until) {
        this(control, mission, until, null, "");
    }

    private MissionWatch(ControlOptions control, String mission, String until, Long deadline, String prefix) {
        this.control = control;
        this.mission = mission;
        this.until = until;
        this.deadline = deadline;
        this.prefix = prefix;
    }

    /** Waits until missions have a state, and prints their progress for people. @return the exit code */
    static int await(ControlOptions control, List<String> missions, String until, Duration timeout) {
        long deadline = System.nanoTime() + timeout.toNanos();
        int code = 0;
        for (String mission : missions) {
            String prefix = missions.size() == 1 ? "" : mission + "  ";
            MissionWatch watch =
                    new MissionWatch(control, mission, until, deadline, control.isForPeople() ? prefix : null);
            code = Math.max(code, watch.run());
            if (!watch.state.isEmpty() && !watch.state.equals(until)) {
                control.warn("mission %s is %s, not %s".formatted(mission, watch.state, until));
            }
        }
        return code;
    }

    /** Returns the exit code, 0 if the state was reached. */
    int run() {
        return control.run(this) == 0 && state.equals(until) ? 0 : 1;
    }

    @Override
    public void with(ControlApi api) throws IOException {
        String path = "/api/missions" + ControlApi.part(mission);
        String shown = "";
        do {
            JsonNode found = api.get(path + (state.equals("created") ? UNTIL_START + seconds() : ""));
            JsonNode status = found.path("status");
            state = status.path("state").asText();
            String line =
                    control.isForPeople() ? line(status) : NgsiJson.mapper().writeValueAsString(found);
            if (prefix != null && !line.equals(shown)) {
                control.out().println(prefix + line);
                control.out().flush();
                shown = line;
            }
        } while (!isOver() && ReplayWatch.pause(POLL_INTERVAL_MILLIS));
    }

    private long seconds() {
        long left = deadline == null ? MAX_WAIT_SECONDS : TimeUnit.NANOSECONDS.toSeconds(deadline - System.nanoTime());
        return Math.max(1, Math.min(left, MAX_WAIT_SECONDS));
    }

    private boolean isOver() {
        boolean isLate = deadline != null && System.nanoTime() - deadline >= 0;
        return isLate || state.equals(until) || state.equals("failed") || state.equals("stopped");
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
