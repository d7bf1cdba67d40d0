package io.furrow.cli.control;

import java.time.Instant;
import java.util.LinkedHashMap;
import java.util.Map;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Parameters;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.time.TimeConverter;

/** {@code ./furrow mission marker}; its help is that of {@code mission}. */
@Command(
        name = "marker",
        description = "Notes at event times of a mission, to find them again in a replay.",
        synopsisSubcommandLabel = "COMMAND")
public final class MarkerCommand {
    private static final String MISSION = "Name of the mission.";

    @Command(name = "list", description = "Lists the markers of a mission.")
    int list(
            @Mixin ControlOptions control,
            @Mixin ListOptions list,
            @Parameters(paramLabel = "MISSION", description = MISSION) String mission) {
        return list.show(
                control,
                path(mission),
                new ControlTable("There is no marker; ./furrow mission marker add %s TIME NOTE makes one."
                                .formatted(mission))
                        .text("MARKER", "/id")
                        .time("TIME", "/time")
                        .text("NOTE", "/note"));
    }

    @Command(name = "add", description = "Adds a marker.")
    int add(
            @Mixin ControlOptions control,
            @Parameters(index = "0", paramLabel = "MISSION", description = MISSION) String mission,
            @Parameters(index = "1", paramLabel = "TIME", description = "Event time, " + TimeConverter.FORMS)
                    Instant time,
            @Parameters(index = "2", paramLabel = "NOTE", description = "Text of the marker.") String note) {
        return control.command("POST", path(mission), ControlOptions.object(body(time, note)));
    }

    @Command(name = "remove", description = "Removes a marker.")
    int remove(
            @Mixin ControlOptions control,
            @Parameters(index = "0", paramLabel = "MISSION", description = MISSION) String mission,
            @Parameters(index = "1", paramLabel = "MARKER", description = "Its id, as list shows it.") String marker) {
        return control.command("DELETE", path(mission) + ControlApi.part(marker), null);
    }

    static String path(String mission) {
        return "/api/missions" + ControlApi.part(mission) + "/markers";
    }

    private static Map<String, Object> body(Instant time, String note) {
        Map<String, Object> body = new LinkedHashMap<>();
        body.put("time", time.toEpochMilli());
        body.put("note", note);
        return body;
    }
}
