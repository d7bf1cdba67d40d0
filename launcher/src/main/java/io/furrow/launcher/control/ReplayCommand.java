package io.furrow.launcher.control;

import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;

import io.furrow.launcher.CommandGroup;

/** {@code ./furrow replay}. */
@Command(
        name = "replay",
        description = "Asks for replays of missions, and steers them.",
        synopsisSubcommandLabel = "COMMAND")
public final class ReplayCommand extends CommandGroup {
    private static final String REPLAYS = "/api/replays";
    private static final String REPLAY = "Name of the replay, as start answers it: MISSION.ID.";
    private static final String TIME = "ISO 8601 or epoch ms.";

    /** What is played back, and how. */
    static final class Choice {
        @Option(names = "--from", paramLabel = "TIME", description = "Event time of the first event: " + TIME)
        private String from;

        @Option(names = "--to", paramLabel = "TIME", description = "Event time after the last event: " + TIME)
        private String to;

        @Option(names = "--speed", paramLabel = "X", description = "0.1 to 1000, or max. Default: 1.")
        private String speed;

        @Option(names = "--loop", description = "Begin anew at the end.")
        private boolean loop;

        @Option(
                names = "--devices",
                paramLabel = "ID",
                split = ",",
                description = "Ids of the entities to play back, parted by commas. Default: all.")
        private List<String> devices;

        Map<String, Object> members() {
            Map<String, Object> members = new LinkedHashMap<>();
            members.put("from", from);
            members.put("to", to);
            members.put("speed", speed == null ? null : number(speed));
            members.put("loop", loop ? true : null);
            members.put("devices", devices);
            return members;
        }
    }

    @Command(name = "list", description = "Lists replays that are not over.")
    int list(@Mixin ControlOptions control) {
        return control.show(
                REPLAYS,
                new ControlTable("There is no replay; ./furrow replay start MISSION asks for one.")
                        .text("REPLAY", "/replay")
                        .text("WANTED", "/wanted")
                        .text("STATE", "/status/state")
                        .text("SPEED", "/speed")
                        .text("TOPIC", "/topic")
                        .time("CREATED", "/created"));
    }

    @Command(name = "start", description = "Asks for a replay of a mission.")
    int start(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "MISSION", description = "Name of the mission.") String mission,
            @Mixin Choice choice) {
        Map<String, Object> body = choice.members();
        body.put("mission", mission);
        return control.command("POST", REPLAYS, ControlOptions.object(body));
    }

    @Command(name = "stop", description = "Ends a replay.")
    int stop(@Mixin ControlOptions control, @Parameters(paramLabel = "REPLAY", description = REPLAY) String replay) {
        return control.command("DELETE", REPLAYS + ControlApi.part(replay), null);
    }

    @Command(name = "pause", description = "Holds a replay.")
    int pause(@Mixin ControlOptions control, @Parameters(paramLabel = "REPLAY", description = REPLAY) String replay) {
        return steer(control, replay, "pause", Map.of());
    }

    @Command(name = "resume", description = "Lets a held replay go on.")
    int resume(@Mixin ControlOptions control, @Parameters(paramLabel = "REPLAY", description = REPLAY) String replay) {
        return steer(control, replay, "resume", Map.of());
    }

    @Command(name = "seek", description = "Jumps to a time.")
    int seek(
            @Mixin ControlOptions control,
            @Parameters(index = "0", paramLabel = "REPLAY", description = REPLAY) String replay,
            @Parameters(index = "1", paramLabel = "TIME", description = "Event time, " + TIME) String to) {
        return steer(control, replay, "seek", Map.of("to", to));
    }

    @Command(name = "speed", description = "Changes the speed.")
    int speed(
            @Mixin ControlOptions control,
            @Parameters(index = "0", paramLabel = "REPLAY", description = REPLAY) String replay,
            @Parameters(index = "1", paramLabel = "X", description = "0.1 to 1000, or max.") String speed) {
        return steer(control, replay, "speed", Map.of("speed", number(speed)));
    }

    @Command(name = "step", description = "Lets a held replay play some events.")
    int step(
            @Mixin ControlOptions control,
            @Parameters(index = "0", paramLabel = "REPLAY", description = REPLAY) String replay,
            @Parameters(
                            index = "1",
                            paramLabel = "N",
                            arity = "0..1",
                            defaultValue = "1",
                            description = "How many. Default: 1.")
                    int count) {
        return steer(control, replay, "step", Map.of("count", count));
    }

    private static int steer(ControlOptions control, String replay, String verb, Map<String, ?> body) {
        return control.command("POST", REPLAYS + ControlApi.part(replay) + "/" + verb, ControlOptions.object(body));
    }

    /** A number where it is one; the control plane refuses other words than max. */
    private static Object number(String speed) {
        try {
            return Double.valueOf(speed);
        } catch (NumberFormatException e) {
            return speed;
        }
    }
}
