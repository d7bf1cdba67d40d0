package io.furrow.cli.control;

import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;

import io.furrow.cli.compare.CompareCommand;
import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.option.CommandGroup;
import io.furrow.cli.time.TimeConverter;

/** {@code ./furrow replay}. */
@Command(
        name = "replay",
        description = "Starts, steers, follows and compares replays of missions.",
        addMethodSubcommands = false,
        synopsisSubcommandLabel = "COMMAND",
        subcommands = CompareCommand.class)
public final class ReplayCommandGroup extends CommandGroup {
    private static final String REPLAYS = "/api/replays";

    @Command(name = "list", description = "Lists replays, including those that wait at their end.")
    int list(@Mixin ControlOptions control, @Mixin ListOptions list) {
        return list.show(
                control,
                REPLAYS,
                new ControlTable("There is no replay; ./furrow replay start MISSION asks for one.")
                        .text("REPLAY", "/replay")
                        .text("GROUP", "/group")
                        .text("STATE", ReplayScreen::listed)
                        .text("SPEED", "/speed")
                        .time("POSITION", "/status/progress/position")
                        .text("TOPIC", "/topic")
                        .time("CREATED", "/created"));
    }

    @Command(
            name = "missions",
            description =
                    "Lists the missions that can be played back: how many events each one has, from when to when.")
    int missions(@Mixin ControlOptions control, @Mixin ListOptions list) {
        return list.show(
                control,
                "/api/recordings",
                new ControlTable("No mission is kept yet.")
                        .text("MISSION", "/mission")
                        .text("EVENTS", "/events")
                        .time("FIRST", "/first")
                        .time("LAST", "/last"));
    }

    @Command(name = "show", description = "Shows one replay: desired state and progress.")
    int show(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "REPLAY", description = "Name of the replay, MISSION.ID.") String replay) {
        return control.showOne(REPLAYS + ControlApi.part(replay));
    }

    @Command(name = "start", description = "Starts a replay of a mission, or of several missions with one clock.")
    int start(@Mixin ControlOptions control, @Mixin ReplayStart start) {
        JsonNode body = start.body(control);
        return control.run(api -> {
            JsonNode answer = api.send("POST", REPLAYS, body);
            control.answered(answer);
            List<String> commands = start.commands(answer);
            if (control.isForPeople() && !commands.isEmpty()) {
                control.out()
                        .println(
                                "Analytics run by themselves beside ./furrow demo, up and replay analytics. On another Flink:");
                commands.forEach(control.out()::println);
            }
        });
    }

    @Command(
            name = "watch",
            description = {
                "Follows a replay. At a terminal it is drawn in place and steered by keys; otherwise it prints a "
                        + "line per second until the end.",
                "Keys: space pauses and resumes; left and right seek by 10 s of event time, [ and ] or with shift by "
                        + "a minute; . and , step while it is paused; + and - double and halve the speed; l sets the begin of "
                        + "a range, then its end, then removes it; m makes a marker; ? shows the keys; q ends."
            })
    int watch(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "REPLAY", description = "Name of the replay, MISSION.ID.") String replay) {
        return control.run(new ReplayWatch(control, REPLAYS + ControlApi.part(replay)));
    }

    @Command(name = "stop", description = "Ends a replay.")
    int stop(@Mixin ControlOptions control, @Mixin ReplayTarget target) {
        target.arguments(control, 0, 0, "nothing");
        return control.commandDone("DELETE", target.path(control), "stopped");
    }

    @Command(name = "pause", description = "Pauses a replay.")
    int pause(@Mixin ControlOptions control, @Mixin ReplayTarget target) {
        target.arguments(control, 0, 0, "nothing");
        return steer(control, target, "pause", Map.of());
    }

    @Command(name = "resume", description = "Resumes a paused replay.")
    int resume(@Mixin ControlOptions control, @Mixin ReplayTarget target) {
        target.arguments(control, 0, 0, "nothing");
        return steer(control, target, "resume", Map.of());
    }

    @Command(name = "seek", description = "Jumps to an event time, " + TimeConverter.FORMS)
    int seek(@Mixin ControlOptions control, @Mixin ReplayTarget target) {
        String to = target.arguments(control, 1, 1, "TIME").get(0);
        return steer(control, target, "seek", Map.of("to", ReplayArguments.time(control, to)));
    }

    @Command(name = "speed", description = "Changes the speed: 0.1 to 1000, or max.")
    int speed(@Mixin ControlOptions control, @Mixin ReplayTarget target) {
        String speed = target.arguments(control, 1, 1, "a speed").get(0);
        return steer(control, target, "speed", Map.of("speed", ReplayArguments.speed(speed)));
    }

    @Command(name = "step", description = "Lets a paused replay play N events, or go back by -N. Default: 1.")
    int step(@Mixin ControlOptions control, @Mixin ReplayTarget target) {
        List<String> arguments = target.arguments(control, 0, 1, "how many events, -N to go back");
        String count = arguments.isEmpty() ? "1" : arguments.get(0);
        if (!count.matches("[+-]?[0-9]{1,7}")) {
            throw control.refused("'%s' is not a number of events".formatted(count));
        }
        return steer(control, target, "step", Map.of("count", Integer.valueOf(count)));
    }

    @Command(name = "loop", description = "Repeats the range between the event times A and B; --off ends it.")
    int loop(
            @Mixin ControlOptions control,
            @Mixin ReplayTarget target,
            @Option(names = "--off", description = "Play on to the end.") boolean off) {
        List<String> arguments =
                off ? target.arguments(control, 0, 0, "nothing") : target.arguments(control, 2, 2, "A B");
        return steer(
                control,
                target,
                "loop",
                off ? Map.of() : ReplayArguments.range(control, arguments.get(0), arguments.get(1)));
    }

    private static int steer(ControlOptions control, ReplayTarget target, String verb, Map<String, ?> body) {
        return control.commandEchoed("POST", target.path(control) + "/" + verb, ControlOptions.object(body));
    }
}
