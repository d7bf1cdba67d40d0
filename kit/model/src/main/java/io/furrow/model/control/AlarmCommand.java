package io.furrow.model.control;

import java.time.Duration;
import java.util.Arrays;
import java.util.stream.Collectors;

import com.fasterxml.jackson.annotation.JsonProperty;
import com.fasterxml.jackson.annotation.JsonTypeName;
import com.fasterxml.jackson.annotation.JsonUnwrapped;

/** A command on the topic {@code service.alarmmanager}. */
public sealed interface AlarmCommand extends Command {
    /** The muted alarms: one, or all of a kind including future ones. */
    sealed interface Target {}

    record OfAlarm(String alarm) implements Target {}

    /** @param subject null for all subjects */
    record OfKind(AlarmKind kind, String subject) implements Target {}

    /**
     * Marks the alarm as seen by a user.
     *
     * @param user null if unknown
     */
    @JsonTypeName("acknowledge")
    record Acknowledge(String alarm, String user) implements AlarmCommand {}

    /**
     * Closes the alarm regardless of its devices.
     *
     * @param user null if unknown
     */
    @JsonTypeName("close")
    record Close(String alarm, String user) implements AlarmCommand {}

    /** Suppresses notifications for a time. */
    @JsonTypeName("mute")
    record Mute(
            @JsonUnwrapped Target target,
            @JsonProperty("for") Duration time) implements AlarmCommand {}

    @JsonTypeName("unmute")
    record Unmute(@JsonUnwrapped Target target) implements AlarmCommand {}

    String ALARM = "alarm";
    String USER = "user";

    /** Returns the alarm that it changes; null if it is about all of a kind. */
    default String alarm() {
        Target target =
                this instanceof Mute mute ? mute.target() : this instanceof Unmute unmute ? unmute.target() : null;
        return target instanceof OfAlarm of ? of.alarm() : null;
    }

    static AlarmCommand read(String verb, JsonObjectReader members) throws RejectedException {
        return switch (verb == null ? "" : verb) {
            case "acknowledge" -> new Acknowledge(members.name(ALARM), members.textOrNull(USER));
            case "close" -> new Close(members.name(ALARM), members.textOrNull(USER));
            case "mute" -> new Mute(target(members), time(members));
            case "unmute" -> new Unmute(target(members));
            default -> throw Requests.unknown(verb, "acknowledge, close, mute, unmute");
        };
    }

    private static Target target(JsonObjectReader members) throws RejectedException {
        if (members.has(ALARM)) {
            return new OfAlarm(members.name(ALARM));
        }
        if (!members.has("kind")) {
            throw new RejectedException(ErrorCode.MISSING_MEMBER, "the request needs a member 'alarm' or 'kind'");
        }
        try {
            return new OfKind(AlarmKind.of(members.text("kind")), members.textOrNull("subject"));
        } catch (IllegalArgumentException e) {
            String kinds =
                    Arrays.stream(AlarmKind.values()).map(AlarmKind::code).collect(Collectors.joining(", "));
            throw JsonObjectReader.wrong("kind", "one of " + kinds);
        }
    }

    private static Duration time(JsonObjectReader members) throws RejectedException {
        Duration time = members.durationOrNull("for");
        if (time == null) {
            throw new RejectedException(
                    ErrorCode.MISSING_MEMBER, "the request needs a member 'for', a time such as PT1H");
        }
        return time;
    }
}
