package io.furrow.model.control;

import java.time.Instant;
import java.util.List;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** What the topic {@code service.replaymanager} asks for. */
public sealed interface ReplayCommand extends Command {
    /** As fast as it goes, as a speed. */
    double MAX = Double.POSITIVE_INFINITY;

    /** How replays are called: {@code <mission>.<id8>}. */
    Pattern REPLAY = Pattern.compile("[A-Za-z0-9_-]{1,64}\\.[0-9a-f]{8}");

    /**
     * @param from event time of the first event; null for the mission's first
     * @param to event time after the last event; null for the mission's end
     * @param speed 0.1 to 1000, or {@link #MAX}
     * @param devices ids of the entities that are played back; empty for all
     */
    record Start(String mission, Instant from, Instant to, double speed, boolean loop, List<String> devices)
            implements ReplayCommand {
        @Override
        public String verb() {
            return "start";
        }

        @Override
        public void describe(ObjectNode request) {
            request.put("mission", mission);
            DeviceGroup.put(request, "from", from);
            DeviceGroup.put(request, "to", to);
            put(request, speed);
            request.put("loop", loop);
            if (!devices.isEmpty()) {
                ArrayNode ids = request.putArray("devices");
                devices.forEach(ids::add);
            }
        }
    }

    /** A command to a replay that is there. */
    sealed interface Steering extends ReplayCommand {
        String replay();
    }

    /** Commands that say no more than which replay they mean. */
    enum Verb {
        STOP,
        PAUSE,
        RESUME
    }

    record Simple(String replay, Verb what) implements Steering {
        @Override
        public String verb() {
            return what.name().toLowerCase(java.util.Locale.ROOT);
        }

        @Override
        public void describe(ObjectNode request) {
            request.put("replay", replay);
        }
    }

    /** @param to event time to go on from */
    record Seek(String replay, Instant to) implements Steering {
        @Override
        public String verb() {
            return "seek";
        }

        @Override
        public void describe(ObjectNode request) {
            request.put("replay", replay);
            DeviceGroup.put(request, "to", to);
        }
    }

    record Speed(String replay, double speed) implements Steering {
        @Override
        public String verb() {
            return "speed";
        }

        @Override
        public void describe(ObjectNode request) {
            request.put("replay", replay);
            put(request, speed);
        }
    }

    /** @param count how many events are played, one after the other, of a replay that is paused */
    record Step(String replay, int count) implements Steering {
        @Override
        public String verb() {
            return "step";
        }

        @Override
        public void describe(ObjectNode request) {
            request.put("replay", replay).put("count", count);
        }
    }

    static ReplayCommand read(String verb, Members members) throws RefusedException {
        return switch (verb == null ? "" : verb) {
            case "start" -> start(members);
            case "stop" -> new Simple(replay(members), Verb.STOP);
            case "pause" -> new Simple(replay(members), Verb.PAUSE);
            case "resume" -> new Simple(replay(members), Verb.RESUME);
            case "seek" -> new Seek(replay(members), needed("to", members));
            case "speed" -> new Speed(replay(members), speed(members, true));
            case "step" -> new Step(replay(members), members.wholeNumber("count", 1, 1_000_000, 1));
            default -> throw Requests.unknown(verb, "start, stop, pause, resume, seek, speed, step");
        };
    }

    private static Start start(Members members) throws RefusedException {
        String mission = members.name("mission");
        Instant from = members.timeOrNull("from");
        Instant to = members.timeOrNull("to");
        if (from != null && to != null && !from.isBefore(to)) {
            throw Members.wrong("to", "after 'from'");
        }
        List<String> devices = members.texts("devices", DeviceGroup.ENTITY_ID, "entity ids");
        return new Start(mission, from, to, speed(members, false), members.flag("loop"), devices);
    }

    private static String replay(Members members) throws RefusedException {
        String replay = members.text("replay");
        if (!REPLAY.matcher(replay).matches()) {
            throw new RefusedException(
                    ErrorCode.ILLEGAL_NAME,
                    "'%s' is no replay; one is called <mission>.<eight hexadecimal digits>"
                            .formatted(Members.quotable(replay)));
        }
        return replay;
    }

    private static Instant needed(String member, Members members) throws RefusedException {
        Instant time = members.timeOrNull(member);
        if (time == null) {
            throw new RefusedException(ErrorCode.MISSING_MEMBER, "the request needs a member '" + member + "'");
        }
        return time;
    }

    private static double speed(Members members, boolean needed) throws RefusedException {
        JsonNode speed = members.json().path("speed");
        if (!members.has("speed")) {
            if (needed) {
                throw new RefusedException(ErrorCode.MISSING_MEMBER, "the request needs a member 'speed'");
            }
            return 1;
        }
        if (speed.isTextual() && speed.textValue().equals("max")) {
            return MAX;
        }
        double number = speed.isNumber() ? speed.doubleValue() : Double.NaN;
        if (!(number >= 0.1 && number <= 1000)) {
            throw Members.wrong("speed", "a number from 0.1 to 1000, or max");
        }
        return number;
    }

    /** Puts a speed as requests have it. */
    static void put(ObjectNode json, double speed) {
        if (speed == MAX) {
            json.put("speed", "max");
        } else {
            json.put("speed", speed);
        }
    }
}
