package io.furrow.cli.control;

import java.time.Duration;
import java.util.LinkedHashMap;
import java.util.Locale;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.option.CommandGroup;

/** {@code ./furrow alarm}. */
@Command(
        name = "alarm",
        description = "Lists, acknowledges, closes and mutes alarms.",
        addMethodSubcommands = false,
        synopsisSubcommandLabel = "COMMAND")
public final class AlarmCommandGroup extends CommandGroup {
    private static final String ALARMS = "/api/alarms";
    private static final int MAX_LISTED = 9999;
    private static final ControlTable TABLE = new ControlTable("There are no such alarms.")
            .text("ALARM", "/alarm")
            .text("SEVERITY", "/severity")
            .text("STATE", "/state")
            .age("AGE", "/raised")
            .time("RAISED", "/raised")
            .time("MUTED UNTIL", "/mutedUntil")
            .text("INHIBITED BY", "/inhibitedBy")
            .text("TEXT", "/text");
    private static final String ID = "Id of the alarm, as list shows it.";

    /** The states to list alarms by. */
    enum State {
        OPEN,
        ACKNOWLEDGED,
        CLOSED,
        ALL;

        String query() {
            return this == ALL ? "" : "&state=" + this;
        }

        /** As it is written on the command line, and in REST. */
        @Override
        public String toString() {
            return name().toLowerCase(Locale.ROOT);
        }
    }

    @Command(name = "list", description = "Lists alarms by severity, the newest first.")
    int list(
            @Mixin ControlOptions control,
            @Option(
                            names = "--state",
                            paramLabel = "STATE",
                            defaultValue = "open",
                            description = "open, acknowledged, closed or all. Default: ${DEFAULT-VALUE}.")
                    State state,
            @Option(
                            names = "--limit",
                            paramLabel = "N",
                            defaultValue = "50",
                            description = "How many at most, 1 to 9999. Default: ${DEFAULT-VALUE}.")
                    int limit) {
        if (limit < 1 || limit > MAX_LISTED) {
            throw control.refused("--limit is 1 to %d, not %d".formatted(MAX_LISTED, limit));
        }
        return control.run(api -> {
            JsonNode alarms = api.get(ALARMS + "?limit=" + (limit + 1) + state.query());
            boolean more = alarms.size() > limit;
            if (more) {
                ((ArrayNode) alarms).remove(limit);
            }
            control.print(alarms, TABLE);
            if (more) {
                control.remark("There are more than %d; --limit shows more of them.".formatted(limit));
            }
        });
    }

    @Command(name = "acknowledge", description = "Acknowledges an alarm.")
    int acknowledge(@Mixin ControlOptions control, @Parameters(paramLabel = "ALARM", description = ID) String alarm) {
        return post(control, alarm, "acknowledge", null);
    }

    @Command(name = "close", description = "Closes an alarm whose cause is over or was not observed for a minute.")
    int close(@Mixin ControlOptions control, @Parameters(paramLabel = "ALARM", description = ID) String alarm) {
        return post(control, alarm, "close", null);
    }

    @Command(name = "mute", description = "Mutes an alarm: the webhook does not get it for some time.")
    int mute(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "ALARM", description = ID) String alarm,
            @Option(
                            names = "--for",
                            paramLabel = "DURATION",
                            defaultValue = "1h",
                            description = "How long, as 30m, 8h or 2d. Default: 1h.")
                    Duration duration) {
        return post(control, alarm, "mute", duration.toString());
    }

    @Command(name = "unmute", description = "Unmutes an alarm: the webhook gets it again.")
    int unmute(@Mixin ControlOptions control, @Parameters(paramLabel = "ALARM", description = ID) String alarm) {
        return post(control, alarm, "unmute", null);
    }

    private static int post(ControlOptions control, String alarm, String verb, String duration) {
        Map<String, String> body = new LinkedHashMap<>();
        body.put("for", duration);
        return control.command("POST", ALARMS + ControlApi.part(alarm) + "/" + verb, ControlOptions.object(body));
    }
}
