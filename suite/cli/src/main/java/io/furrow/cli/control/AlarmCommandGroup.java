package io.furrow.cli.control;

import java.time.Duration;
import java.time.Instant;
import java.util.LinkedHashMap;
import java.util.List;
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
import io.furrow.cli.control.client.ListLimit;
import io.furrow.cli.control.table.AlarmPage;
import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.option.CommandGroup;
import io.furrow.cli.time.TimeRangeOptions;
import io.furrow.model.ngsi.NgsiJson;

/** {@code ./furrow alarm}. */
@Command(
        name = "alarm",
        description = "Lists, shows, acknowledges, closes and mutes alarms.",
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

        /** As it is written on the command line, and in REST. */
        @Override
        public String toString() {
            return name().toLowerCase(Locale.ROOT);
        }
    }

    @Command(
            name = "list",
            description = {
                "Lists alarms by severity, the newest first.",
                "A time selects those that were not closed before --since and were raised before --to. A closed alarm is kept for a day."
            })
    int list(
            @Mixin ControlOptions control,
            @Option(
                            names = "--state",
                            paramLabel = "STATE",
                            description = "open, acknowledged, closed or all. Default: open; with --since or --to all.")
                    State state,
            @Option(names = "--kind", paramLabel = "KIND", description = "Only those of a kind, as silent-device.")
                    String kind,
            @Mixin TimeRangeOptions range,
            @Option(
                            names = {"-n", "--limit"},
                            paramLabel = "N",
                            defaultValue = "50",
                            description = "How many at most, 1 to 9999. Default: ${DEFAULT-VALUE}.")
                    int limit,
            @Mixin ListWatch watch) {
        ListLimit.check(control, limit, MAX_LISTED);
        State desired = state != null ? state : range.isGiven() ? State.ALL : State.OPEN;
        Map<String, Object> query = new LinkedHashMap<>();
        query.put("limit", limit + 1);
        query.put("state", desired == State.ALL ? null : desired);
        query.put("kind", kind);
        range.addTo(query);
        String path = ALARMS + ControlApi.query(query);
        return control.run(api -> {
            JsonNode alarms = api.get(path);
            boolean more = alarms.size() > limit;
            JsonNode listed = first(alarms, limit);
            control.print(listed, TABLE);
            if (more) {
                control.remark("There are more than %d; --limit shows more of them.".formatted(limit));
            }
            watch.follow(control, listed, () -> first(api.get(path), limit), TABLE);
        });
    }

    private static JsonNode first(JsonNode alarms, int limit) {
        if (alarms.size() > limit) {
            ((ArrayNode) alarms).remove(limit);
        }
        return alarms;
    }

    @Command(name = "show", description = "Shows one alarm: its text, its devices, and what was done about it.")
    int show(@Mixin ControlOptions control, @Parameters(paramLabel = "ALARM", description = ID) String alarm) {
        return control.showPage(ALARMS + ControlApi.part(alarm), shown -> AlarmPage.of(shown, Instant.now()));
    }

    @Command(name = "acknowledge", description = "Acknowledges alarms.")
    int acknowledge(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "ALARM", arity = "1..*", description = ID) List<String> alarms) {
        return control.commands("POST", paths(alarms, "acknowledge"), NgsiJson.object());
    }

    @Command(name = "close", description = "Closes alarms whose cause is over or was not observed for a minute.")
    int close(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "ALARM", arity = "1..*", description = ID) List<String> alarms) {
        return control.commands("POST", paths(alarms, "close"), NgsiJson.object());
    }

    @Command(
            name = "mute",
            description =
                    "Mutes alarms, or a kind of alarms, those to come too: the webhook does not get them for some "
                            + "time.")
    int mute(
            @Mixin ControlOptions control,
            @Mixin Muted muted,
            @Option(
                            names = "--for",
                            paramLabel = "DURATION",
                            defaultValue = "1h",
                            description = "How long, as 30m, 8h or 2d. Default: 1h.")
                    Duration duration) {
        return muted.send(control, "mute", duration.toString());
    }

    @Command(name = "unmute", description = "Unmutes alarms, or a kind of alarms: the webhook gets them again.")
    int unmute(@Mixin ControlOptions control, @Mixin Muted muted) {
        return muted.send(control, "unmute", null);
    }

    /** Alarms by id, or by kind. */
    static final class Muted {
        @Parameters(paramLabel = "ALARM", arity = "0..*", description = ID)
        private List<String> alarms;

        @Option(names = "--kind", paramLabel = "KIND", description = "All alarms of this kind, as silent-device.")
        private String kind;

        @Option(
                names = "--subject",
                paramLabel = "SUBJECT",
                description = "Of these, those about one subject, as the id of a device.")
        private String subject;

        int send(ControlOptions control, String verb, String duration) {
            if ((alarms == null) == (kind == null) || alarms != null && subject != null) {
                throw control.refused("Name alarms, or a kind with --kind, and its --subject.");
            }
            Map<String, String> body = new LinkedHashMap<>();
            body.put("kind", kind);
            body.put("subject", subject);
            body.put("for", duration);
            List<String> paths = alarms == null ? List.of(ALARMS + "/" + verb) : paths(alarms, verb);
            return control.commands("POST", paths, ControlOptions.object(body));
        }
    }

    private static List<String> paths(List<String> alarms, String verb) {
        return alarms.stream()
                .map(alarm -> ALARMS + ControlApi.part(alarm) + "/" + verb)
                .toList();
    }
}
