package io.furrow.model.control;

import java.util.Objects;

import com.fasterxml.jackson.annotation.JsonProperty;
import com.fasterxml.jackson.annotation.JsonUnwrapped;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.annotation.JsonSerialize;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.fasterxml.jackson.databind.util.StdConverter;

import io.furrow.model.control.ReplayStatus.State;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.StateRecord;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * A record of {@code service.replays}: the complete desired state of a replay, because compaction may remove all but
 * the newest record. The manager's state has this form, too. The replay's player reports on {@code
 * service.replays.status}, see {@link ReplayStatus}.
 *
 * @param replay {@code <mission>.<id8>}, the record's key
 * @param topic on which it is played
 * @param group id of the group whose clock it follows; null if it is in none
 * @param speed 0.1 to 1000, or {@link ReplayCommand#MAX}
 * @param range the part to repeat; null to play the whole recording
 * @param desired running, paused or stopped
 * @param seek the newest requested seek; null if there was none
 * @param step the newest requested steps; null if there were none
 * @param clock of the group; null if it is in none
 * @param created time of creation, epoch ms
 * @param sequence grows with every change of the replay
 */
public record DesiredReplay(
        String replay,
        String mission,
        String topic,
        String group,
        @JsonUnwrapped ReplayPlan plan,

        @JsonSerialize(converter = ReplayCommand.SpeedToJson.class)
        double speed,

        Range range,

        @JsonProperty("wanted") @JsonSerialize(converter = StateToText.class)
        State desired,

        Seek seek,
        Step step,
        Clock clock,
        long created,
        long sequence)
        implements StateRecord {

    /**
     * A part of the recording, between event times.
     *
     * @param from epoch ms
     * @param to epoch ms, exclusive
     */
    public record Range(long from, long to) {
        static Range read(JsonObjectReader members) throws RejectedException {
            long from = members.time("from").toEpochMilli();
            long to = members.time("to").toEpochMilli();
            JsonObjectReader.refuseIf(from >= to, "to", "after 'from'");
            return new Range(from, to);
        }
    }

    /**
     * A seek; a player applies it if its sequence is new.
     *
     * @param to event time, epoch ms
     */
    public record Seek(long to, long sequence) {}

    /** @param total requested steps since the replay was started, less those back */
    public record Step(long total, long sequence) {}

    /**
     * The clock of all replays of a group: it shows an event time at a moment, and from then on runs at the speed
     * unless the replay is paused.
     *
     * @param at epoch ms of the machines' clock
     * @param shows event time, epoch ms
     */
    public record Clock(long at, long shows) {
        /** Returns the event time that it shows, epoch ms; before its moment the initial one. */
        public long position(long now, double speed) {
            return shows + (long) Math.floor(Math.max(0, now - at) * speed);
        }

        /** Returns {@link #position(long, double)}, restarting at the beginning of the range whenever it ends. */
        public long position(long now, double speed, Range loop) {
            long position = position(now, speed);
            return position < loop.to ? position : loop.from + (position - loop.from) % (loop.to - loop.from);
        }
    }

    private static final class StateToText extends StdConverter<State, String> {
        @Override
        public String convert(State state) {
            return state.code();
        }
    }

    public DesiredReplay {
        Objects.requireNonNull(plan);
        Objects.requireNonNull(desired);
    }

    /** Returns a replay without any command. */
    public static DesiredReplay started(
            String mission, String topic, ReplayPlan plan, double speed, long created, long sequence) {
        String replay = mission + topic.substring(topic.lastIndexOf('.'));
        return new DesiredReplay(
                replay, mission, topic, null, plan, speed, null, State.RUNNING, null, null, null, created, sequence);
    }

    public DesiredReplay desired(State next, long newSequence) {
        return changed(speed, range, next, seek, step, newSequence);
    }

    public DesiredReplay at(double newSpeed, long newSequence) {
        return changed(newSpeed, range, desired, seek, step, newSequence);
    }

    /** @param newRange null for the whole recording */
    public DesiredReplay within(Range newRange, long newSequence) {
        return changed(speed, newRange, desired, seek, step, newSequence);
    }

    public DesiredReplay seeking(long time, long newSequence) {
        return changed(speed, range, desired, new Seek(time, newSequence), step, newSequence);
    }

    /** @param count events; negative to step back */
    public DesiredReplay stepping(int count, long newSequence) {
        long total = (step == null ? 0 : step.total) + count;
        return changed(speed, range, desired, seek, new Step(total, newSequence), newSequence);
    }

    /** Returns the replay as a member of a group that follows its clock. */
    public DesiredReplay following(String newGroup, Clock newClock) {
        return new DesiredReplay(
                replay, mission, topic, newGroup, plan, speed, range, desired, seek, step, newClock, created, sequence);
    }

    private DesiredReplay changed(double speed, Range range, State desired, Seek seek, Step step, long sequence) {
        return new DesiredReplay(
                replay, mission, topic, group, plan, speed, range, desired, seek, step, clock, created, sequence);
    }

    /**
     * Returns the first event time to play, epoch ms.
     *
     * @param first event time at which the recording begins, epoch ms
     */
    public long from(long first) {
        long min = plan.from() == null ? first : Math.max(first, plan.from());
        return range == null ? min : Math.max(min, range.from);
    }

    /**
     * Returns the end of the played event times, epoch ms, exclusive; {@link Long#MAX_VALUE} for the recording's end.
     */
    public long to() {
        long max = plan.to() == null ? Long.MAX_VALUE : plan.to();
        return range == null ? max : Math.min(max, range.to);
    }

    /** Returns the event time that the group's clock shows, epoch ms, within the played range. */
    public long position(long now) {
        if (desired != State.RUNNING) {
            return clock.shows;
        }
        Range all = new Range(from(plan.from()), to());
        return loops() ? clock.position(now, speed, all) : Math.min(clock.position(now, speed), all.to);
    }

    /** Returns whether it restarts at the end. */
    public boolean loops() {
        return plan.loop() || range != null;
    }

    /**
     * Reads a record; unknown members are ignored.
     *
     * @throws UnreadableException with {@link Reason#NOT_JSON}, or {@link Reason#NOT_AN_EVENT} if it is not such an
     * object, does not match its key, or names a topic of another replay
     */
    public static DesiredReplay read(String key, byte[] value) throws UnreadableException {
        DesiredReplay replay = read(value);
        if (!replay.replay.equals(key)) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, "it does not belong to the key " + key);
        }
        return replay;
    }

    /**
     * Reads a record without its key.
     *
     * @throws UnreadableException as {@link #read(String, byte[])}
     */
    public static DesiredReplay read(byte[] value) throws UnreadableException {
        if (!(NgsiJson.read(value) instanceof ObjectNode json)) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, "it is not an object");
        }
        try {
            DesiredReplay replay = read(new JsonObjectReader(json));
            Reason.NOT_AN_EVENT.refuseIf(
                    !replay.belongsTogether(), "'replay', 'mission' and 'topic' do not belong together");
            return replay;
        } catch (RejectedException e) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, e.getMessage());
        }
    }

    /** Returns the sequence of a record that may be unreadable otherwise; 0 if it has none. */
    public static long sequence(byte[] value) {
        try {
            JsonNode sequence = NgsiJson.read(value).path("sequence");
            return sequence.isIntegralNumber() && sequence.canConvertToLong() ? sequence.longValue() : 0;
        } catch (UnreadableException e) {
            return 0;
        }
    }

    private static DesiredReplay read(JsonObjectReader members) throws RejectedException {
        return new DesiredReplay(
                members.text("replay"),
                members.text("mission"),
                members.text("topic"),
                members.textOrNull("group"),
                ReplayPlan.read(members),
                ReplayCommand.speed(members, true),
                members.partOrNull("range", Range::read),
                desired(members),
                members.partOrNull("seek", part -> new Seek(part.number("to"), part.number("sequence"))),
                members.partOrNull("step", part -> new Step(part.number("total"), part.number("sequence"))),
                members.partOrNull("clock", part -> new Clock(part.number("at"), part.number("shows"))),
                members.has("created") ? members.number("created") : 0,
                members.number("sequence"));
    }

    private static State desired(JsonObjectReader members) throws RejectedException {
        return switch (members.text("wanted")) {
            case "running" -> State.RUNNING;
            case "paused" -> State.PAUSED;
            case "stopped" -> State.STOPPED;
            default -> throw JsonObjectReader.wrong("wanted", "running, paused or stopped");
        };
    }

    /**
     * Returns whether replay, mission and topic match. The topic may have another name than the mission's, but must end
     * with the replay's id.
     */
    private boolean belongsTogether() {
        return ReplayCommand.REPLAY.matcher(replay).matches()
                && replay.substring(0, replay.lastIndexOf('.')).equals(mission)
                && Topics.isReplay(topic)
                && topic.endsWith(replay.substring(replay.lastIndexOf('.')));
    }
}
