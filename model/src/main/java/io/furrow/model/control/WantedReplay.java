package io.furrow.model.control;

import java.util.ArrayList;
import java.util.List;
import java.util.Objects;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * A record of {@code service.replays} as the control plane writes it: the replay that is wanted, whole, because compaction may take
 * away all but the newest record. Whoever plays it back says so on {@code service.replays.status}, see {@link ReplayStatus}.
 *
 * @param replay {@code <mission>.<id8>}, the record's key
 * @param topic on which it is played
 * @param from event time of the first event, epoch ms; null for the mission's first
 * @param to event time after the last event, epoch ms; null for the mission's end
 * @param speed 0.1 to 1000, or {@link ReplayCommand#MAX}
 * @param loop whether it begins anew at the end
 * @param devices ids of the entities that are played back; empty for all
 * @param seek the newest jump that was asked for; null where none was
 * @param step the newest steps that were asked for; null where none were
 * @param sequence grows with every change of the replay
 */
public record WantedReplay(
        String replay,
        String mission,
        String topic,
        Long from,
        Long to,
        double speed,
        boolean loop,
        List<String> devices,
        ReplayStatus.State wanted,
        Seek seek,
        Step step,
        long sequence) {
    private static final double SLOWEST = 0.1;
    private static final double FASTEST = 1000;

    /**
     * A jump, for whoever has not yet applied its sequence.
     *
     * @param to event time, epoch ms
     */
    public record Seek(long to, long sequence) {}

    /** @param total events asked for one by one since the replay was started */
    public record Step(long total, long sequence) {}

    public WantedReplay {
        Objects.requireNonNull(wanted);
        devices = List.copyOf(devices);
    }

    /** Whether these two are the name of a replay and its topic. */
    private static boolean belong(String replay, String mission, String topic) {
        return ReplayCommand.REPLAY.matcher(replay).matches()
                && replay.substring(0, replay.lastIndexOf('.')).equals(mission)
                && Topics.replay(mission, replay.substring(replay.lastIndexOf('.') + 1))
                        .equals(topic);
    }

    /**
     * Reads a record; members of other names are passed over.
     *
     * @throws UnreadableException with {@link Reason#NOT_JSON}, or {@link Reason#NOT_AN_EVENT} where it is no such object, is another
     *     replay's than its key says, or names a topic that is not this replay's
     */
    public static WantedReplay read(String key, byte[] value) throws UnreadableException {
        JsonNode json = NgsiJson.read(value);
        String replay = text(json, "replay");
        String mission = text(json, "mission");
        String topic = text(json, "topic");
        if (!replay.equals(key) || !belong(replay, mission, topic)) {
            throw wrong("'replay', 'mission' and 'topic' do not belong together, or to the key " + key);
        }
        return new WantedReplay(
                replay,
                mission,
                topic,
                numberOrNull(json, "from"),
                numberOrNull(json, "to"),
                speed(json.path("speed")),
                flag(json, "loop"),
                devices(json.path("devices")),
                wanted(json.path("wanted")),
                seek(json.path("seek")),
                step(json.path("step")),
                number(json, "sequence"));
    }

    private static String text(JsonNode json, String member) throws UnreadableException {
        if (!json.path(member).isTextual()) {
            throw wrong("'" + member + "' is no text");
        }
        return json.path(member).textValue();
    }

    private static long number(JsonNode json, String member) throws UnreadableException {
        JsonNode number = json.path(member);
        if (!number.isIntegralNumber() || !number.canConvertToLong()) {
            throw wrong("'" + member + "' is no whole number");
        }
        return number.longValue();
    }

    private static Long numberOrNull(JsonNode json, String member) throws UnreadableException {
        return json.hasNonNull(member) ? Long.valueOf(number(json, member)) : null;
    }

    private static boolean flag(JsonNode json, String member) throws UnreadableException {
        JsonNode flag = json.path(member);
        if (!flag.isMissingNode() && !flag.isBoolean()) {
            throw wrong("'" + member + "' is neither true nor false");
        }
        return flag.booleanValue();
    }

    private static double speed(JsonNode speed) throws UnreadableException {
        if ("max".equals(speed.textValue())) {
            return ReplayCommand.MAX;
        }
        double number = speed.isNumber() ? speed.doubleValue() : Double.NaN;
        if (!(number >= SLOWEST && number <= FASTEST)) {
            throw wrong("'speed' is neither a number from 0.1 to 1000 nor max");
        }
        return number;
    }

    private static List<String> devices(JsonNode list) throws UnreadableException {
        List<String> devices = new ArrayList<>();
        if (!list.isMissingNode() && !list.isNull() && !list.isArray()) {
            throw wrong("'devices' is no list of entity ids");
        }
        for (JsonNode id : list) {
            if (!id.isTextual()) {
                throw wrong("'devices' is no list of entity ids");
            }
            devices.add(id.textValue());
        }
        return devices;
    }

    private static ReplayStatus.State wanted(JsonNode word) throws UnreadableException {
        return switch (word.asText()) {
            case "running" -> ReplayStatus.State.RUNNING;
            case "paused" -> ReplayStatus.State.PAUSED;
            case "stopped" -> ReplayStatus.State.STOPPED;
            default -> throw wrong("'wanted' is not running, paused or stopped");
        };
    }

    private static Seek seek(JsonNode seek) throws UnreadableException {
        return seek.isMissingNode() || seek.isNull() ? null : new Seek(number(seek, "to"), number(seek, "sequence"));
    }

    private static Step step(JsonNode step) throws UnreadableException {
        return step.isMissingNode() || step.isNull() ? null : new Step(number(step, "total"), number(step, "sequence"));
    }

    private static UnreadableException wrong(String what) {
        return new UnreadableException(Reason.NOT_AN_EVENT, what);
    }

    public byte[] toBytes() {
        ObjectNode json = JsonNodeFactory.instance.objectNode();
        json.put("replay", replay).put("mission", mission).put("topic", topic);
        if (from != null) {
            json.put("from", from);
        }
        if (to != null) {
            json.put("to", to);
        }
        json.set("speed", ReplayCommand.json(speed));
        ArrayNode ids = json.put("loop", loop).putArray("devices");
        devices.forEach(ids::add);
        json.put("wanted", wanted.word());
        if (seek != null) {
            json.putObject("seek").put("to", seek.to).put("sequence", seek.sequence);
        }
        if (step != null) {
            json.putObject("step").put("total", step.total).put("sequence", step.sequence);
        }
        return NgsiJson.write(json.put("sequence", sequence));
    }
}
