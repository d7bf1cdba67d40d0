package io.furrow.launcher.control;

import java.util.LinkedHashMap;
import java.util.Map;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;

import io.furrow.launcher.CommandGroup;

/** {@code ./furrow alarm}. */
@Command(
        name = "alarm",
        description = "Lists, acknowledges, closes and mutes alarms.",
        synopsisSubcommandLabel = "COMMAND")
public final class AlarmCommand extends CommandGroup {
    private static final String ALARMS = "/api/alarms";
    private static final String ID = "Id of the alarm, as list shows it.";

    @Command(name = "list", description = "Lists alarms.")
    int list(
            @Mixin ControlOptions control,
            @Option(names = "--state", paramLabel = "STATE", description = "Only open, acknowledged or closed ones.")
                    String state) {
        return control.show(
                state == null
                        ? ALARMS
                        : ALARMS + "?state=" + ControlApi.part(state).substring(1),
                new ControlTable("There is no such alarm.")
                        .text("ALARM", "/alarm")
                        .text("KIND", "/kind")
                        .text("SUBJECT", "/subject")
                        .text("SEVERITY", "/severity")
                        .text("STATE", "/state")
                        .time("RAISED", "/raised")
                        .text("TEXT", "/text"));
    }

    @Command(name = "acknowledge", description = "Says that somebody looks after an alarm.")
    int acknowledge(@Mixin ControlOptions control, @Parameters(paramLabel = "ALARM", description = ID) String alarm) {
        return tell(control, alarm, "acknowledge", null);
    }

    @Command(name = "close", description = "Closes an alarm.")
    int close(@Mixin ControlOptions control, @Parameters(paramLabel = "ALARM", description = ID) String alarm) {
        return tell(control, alarm, "close", null);
    }

    @Command(name = "mute", description = "Sends no more word of an alarm for some time.")
    int mute(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "ALARM", description = ID) String alarm,
            @Option(
                            names = "--for",
                            paramLabel = "DURATION",
                            defaultValue = "PT1H",
                            description = "ISO 8601. Default: PT1H.")
                    String duration) {
        return tell(control, alarm, "mute", duration);
    }

    @Command(name = "unmute", description = "Sends word of an alarm again.")
    int unmute(@Mixin ControlOptions control, @Parameters(paramLabel = "ALARM", description = ID) String alarm) {
        return tell(control, alarm, "unmute", null);
    }

    private static int tell(ControlOptions control, String alarm, String verb, String duration) {
        Map<String, String> body = new LinkedHashMap<>();
        body.put("for", duration);
        return control.command("POST", ALARMS + ControlApi.part(alarm) + "/" + verb, ControlOptions.object(body));
    }
}
