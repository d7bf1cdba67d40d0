package io.furrow.model.control;

import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Pattern;

import com.fasterxml.jackson.annotation.JsonIgnore;
import com.fasterxml.jackson.annotation.JsonTypeName;
import com.fasterxml.jackson.annotation.JsonUnwrapped;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.annotation.JsonSerialize;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.fasterxml.jackson.databind.util.StdConverter;

import io.furrow.model.topic.TopicName;

/** A command on the topic {@code service.replaymanager}. */
public sealed interface ReplayCommand extends Command {
    /** The speed of a replay without a schedule. */
    double MAX = Double.POSITIVE_INFINITY;

    /** Names of replays: {@code <mission>.<id8>}. */
    Pattern REPLAY = Pattern.compile("[A-Za-z0-9_-]{1,64}\\.[0-9a-f]{8}");

    /** Topics that a request may name for a replay. */
    Pattern TOPIC = Pattern.compile("data\\.[A-Za-z0-9_-]{1,64}\\.replay\\.[0-9a-f]{8}");

    /** Names of groups: the {@code id8} of their replays. */
    Pattern GROUP = Pattern.compile("[0-9a-f]{8}");

    /** Maximum missions of a group. */
    int MAX_OF_GROUP = 16;

    /**
     * @param missions one, or several that follow one clock
     * @param topic topic of a single mission's replay; null for one named after the mission
     * @param speed 0.1 to 1000, or {@link #MAX}
     * @param range the part to repeat; null to play the whole recording
     */
    @JsonTypeName("start")
    record Start(
            @JsonIgnore List<String> missions,
            String topic,
            @JsonSerialize(converter = SpeedToJson.class) double speed,
            DesiredReplay.Range range,
            @JsonUnwrapped ReplayPlan plan)
            implements ReplayCommand {
        public Start {
            missions = List.copyOf(missions);
        }

        /** Returns whether it starts replays that follow one clock. */
        @JsonIgnore
        public boolean isGroup() {
            return missions.size() > 1;
        }

        @Override
        public void describe(ObjectNode request) {
            if (isGroup()) {
                missions.forEach(request.putArray("missions")::add);
            } else {
                request.put("mission", missions.get(0));
            }
            ReplayCommand.super.describe(request);
        }

        private static Start read(JsonObjectReader members) throws RejectedException {
            List<String> missions = missions(members);
            String topic = members.textOrNull("topic");
            JsonObjectReader.refuseIf(
                    topic != null
                            && (missions.size() > 1 || !TOPIC.matcher(topic).matches()),
                    "topic",
                    "data.<name>.replay.<eight hexadecimal digits>, and is for one mission only");
            ReplayPlan plan = ReplayPlan.read(members);
            double speed = ReplayCommand.speed(members, false);
            JsonObjectReader.refuseIf(
                    missions.size() > 1 && (speed == MAX || plan.maxGap() != null || plan.source() != null),
                    "missions",
                    "one where 'speed' is max, or 'maxGap' or 'source' is given");
            return new Start(missions, topic, speed, members.partOrNull("range", DesiredReplay.Range::read), plan);
        }

        private static List<String> missions(JsonObjectReader members) throws RejectedException {
            if (!members.has("missions")) {
                return List.of(members.name("mission"));
            }
            ArrayNode names = members.arrayOrNull("missions", MAX_OF_GROUP);
            List<String> missions = new ArrayList<>();
            for (JsonNode name : names) {
                JsonObjectReader.refuseIf(
                        !TopicName.isLegal(name.asText()) || missions.contains(name.asText()),
                        "missions",
                        "a list of different names of missions");
                missions.add(name.asText());
            }
            JsonObjectReader.refuseIf(
                    missions.isEmpty() || members.has("mission"),
                    "missions",
                    "a list of missions, without 'mission' beside it");
            return missions;
        }
    }

    /**
     * A command to an existing replay or group.
     *
     * @see Target
     */
    sealed interface Steering extends ReplayCommand {
        Target target();
    }

    /**
     * The target of a command: a replay by its name, or all replays of a group.
     *
     * @param replay null for a group
     * @param group null for a replay
     */
    record Target(String replay, String group) {
        static Target of(String replay) {
            return new Target(replay, null);
        }

        private static Target read(JsonObjectReader members) throws RejectedException {
            String group = members.textOrNull("group");
            if (group == null) {
                return of(checkName(members.text("replay")));
            }
            JsonObjectReader.refuseIf(members.has("replay"), "group", "without 'replay' beside it");
            if (!GROUP.matcher(group).matches()) {
                throw new RejectedException(
                        ErrorCode.ILLEGAL_NAME,
                        "'%s' is not a group; one is called by eight hexadecimal digits"
                                .formatted(JsonObjectReader.quotable(group)));
            }
            return new Target(null, group);
        }

        private static String checkName(String replay) throws RejectedException {
            if (!REPLAY.matcher(replay).matches()) {
                throw new RejectedException(
                        ErrorCode.ILLEGAL_NAME,
                        "'%s' is not a replay; one is called <mission>.<eight hexadecimal digits>"
                                .formatted(JsonObjectReader.quotable(replay)));
            }
            return replay;
        }

        /** Returns the target for use in messages. */
        @Override
        public String toString() {
            return replay == null ? "group '" + group + "'" : "replay '" + replay + "'";
        }
    }

    /** Commands without further members. */
    enum Verb {
        STOP,
        PAUSE,
        RESUME
    }

    record Simple(@JsonUnwrapped Target target, @JsonIgnore Verb what) implements Steering {
        @Override
        public String verb() {
            return what.name().toLowerCase(java.util.Locale.ROOT);
        }
    }

    /** @param to event time to continue from */
    @JsonTypeName("seek")
    record Seek(@JsonUnwrapped Target target, Instant to) implements Steering {}

    @JsonTypeName("speed")
    record Speed(
            @JsonUnwrapped Target target,
            @JsonSerialize(converter = SpeedToJson.class) double speed) implements Steering {}

    /** @param count number of events that a paused replay plays; negative to step back */
    @JsonTypeName("step")
    record Step(@JsonUnwrapped Target target, int count) implements Steering {}

    /** @param range the part to repeat from now on; null to play the whole recording */
    @JsonTypeName("loop")
    record Loop(@JsonUnwrapped Target target, @JsonUnwrapped DesiredReplay.Range range) implements Steering {}

    static ReplayCommand read(String verb, JsonObjectReader members) throws RejectedException {
        return switch (verb == null ? "" : verb) {
            case "start" -> Start.read(members);
            case "stop" -> new Simple(Target.read(members), Verb.STOP);
            case "pause" -> new Simple(Target.read(members), Verb.PAUSE);
            case "resume" -> new Simple(Target.read(members), Verb.RESUME);
            case "seek" -> new Seek(Target.read(members), members.time("to"));
            case "speed" -> new Speed(Target.read(members), speed(members, true));
            case "step" -> new Step(Target.read(members), steps(members));
            case "loop" -> new Loop(Target.read(members), range(members));
            default -> throw Requests.unknown(verb, "start, stop, pause, resume, seek, speed, step, loop");
        };
    }

    private static int steps(JsonObjectReader members) throws RejectedException {
        int count = members.wholeNumber("count", -1_000_000, 1_000_000, 1);
        JsonObjectReader.refuseIf(count == 0, "count", "a whole number from -1000000 to 1000000, and not 0");
        return count;
    }

    private static DesiredReplay.Range range(JsonObjectReader members) throws RejectedException {
        return members.has("from") || members.has("to") ? DesiredReplay.Range.read(members) : null;
    }

    static double speed(JsonObjectReader members, boolean needed) throws RejectedException {
        JsonNode speed = members.json().path("speed");
        if (!members.has("speed")) {
            if (needed) {
                throw JsonObjectReader.missing("speed");
            }
            return 1;
        }
        if (speed.isTextual() && speed.textValue().equals("max")) {
            return MAX;
        }
        double number = speed.isNumber() ? speed.doubleValue() : Double.NaN;
        JsonObjectReader.refuseIf(!(number >= 0.1 && number <= 1000), "speed", "a number from 0.1 to 1000, or max");
        return number;
    }

    /** Writes a speed as requests have it: a number, or {@code max}. */
    final class SpeedToJson extends StdConverter<Double, Object> {
        @Override
        public Object convert(Double speed) {
            return speed == MAX ? "max" : speed;
        }
    }
}
