package io.furrow.cli.control;

import java.util.List;

import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;

/** The target of a command: one replay, or with {@code --group} all of a group; and the command's further arguments. */
final class ReplayTarget {
    private static final String REPLAYS = "/api/replays";

    @Option(
            names = "--group",
            paramLabel = "GROUP",
            description = "All replays of this group, as printed by start; omit REPLAY.")
    private String group;

    @Parameters(
            arity = "0..*",
            paramLabel = "REPLAY …",
            hideParamSyntax = true,
            description = "Name of the replay as printed by start, MISSION.ID; then the arguments of the command.")
    private List<String> arguments = List.of();

    /** The target's path. */
    String path(ControlOptions control) {
        if (group != null) {
            return ofGroup(group);
        } else if (arguments.isEmpty() || arguments.get(0).startsWith("-")) {
            throw control.refused("Name a replay, MISSION.ID, or a group with --group");
        }
        return REPLAYS + ControlApi.part(arguments.get(0));
    }

    /** The path of a group. */
    static String ofGroup(String group) {
        return REPLAYS + "/groups" + ControlApi.part(group);
    }

    /**
     * The arguments after the replay.
     *
     * @param min least number of them
     * @param max greatest number of them
     * @param what they are, for the error message
     */
    List<String> arguments(ControlOptions control, int min, int max, String what) {
        String path = path(control);
        List<String> own = group == null ? arguments.subList(1, arguments.size()) : arguments;
        if (own.size() < min || own.size() > max) {
            throw control.refused("After %s comes %s; there is '%s'"
                    .formatted(path.substring(REPLAYS.length() + 1), what, String.join(" ", own)));
        }
        return own;
    }
}
