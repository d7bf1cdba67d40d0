package io.furrow.model.control;

import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.regex.Pattern;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.databind.annotation.JsonSerialize;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.fasterxml.jackson.databind.util.StdConverter;

import io.furrow.model.result.AnalyticsKind;
import io.furrow.model.text.Coded;

/**
 * The plan of a replay, as requested at its start.
 *
 * @param source where the recording is; null for the missions in MongoDB
 * @param from event time of the first event, epoch ms; null for the recording's first
 * @param to event time after the last event, epoch ms; null for the recording's end
 * @param loop whether it restarts at the end
 * @param devices ids of the entities to play; empty for all
 * @param maxGap maximum gap between events, ms of event time; longer gaps are shortened to it. Null for no maximum
 * @param startAt when the first event is due, epoch ms; null to start at once
 * @param analytics the analytics jobs that run on the replay's topic during the replay
 */
public record ReplayPlan(
        Source source,
        Long from,
        Long to,
        boolean loop,
        @JsonInclude(JsonInclude.Include.NON_EMPTY) List<String> devices,
        @JsonSerialize(converter = GapToText.class) Long maxGap,

        @JsonSerialize(converter = StampsToText.class) @JsonInclude(JsonInclude.Include.NON_EMPTY)
        Stamps stamps,

        Long startAt,
        @JsonInclude(JsonInclude.Include.NON_EMPTY) List<String> analytics) {
    /** Plays a whole mission once. */
    public static final ReplayPlan PLAIN =
            new ReplayPlan(null, null, null, false, List.of(), null, Stamps.ORIGINAL, null, List.of());

    private static final Pattern TOPIC = Pattern.compile("data\\.[A-Za-z0-9._-]{1,240}");
    private static final Pattern FILE = Pattern.compile("[A-Za-z0-9_-][A-Za-z0-9._-]{0,199}");

    /** A recording outside of MongoDB: either a topic or a file. */
    public record Source(String topic, String file) {
        private static Source read(ObjectNode json) throws RejectedException {
            JsonObjectReader members = new JsonObjectReader(json);
            Source source = new Source(members.textOrNull("topic"), members.textOrNull("file"));
            JsonObjectReader.refuseIf(
                    (source.topic == null) == (source.file == null),
                    "source",
                    "an object with either 'topic' or 'file'");
            JsonObjectReader.refuseIf(
                    source.topic != null && !TOPIC.matcher(source.topic).matches(),
                    "topic",
                    "a topic that begins with data.");
            JsonObjectReader.refuseIf(
                    source.file != null && !FILE.matcher(source.file).matches(),
                    "file",
                    "the name of a file in the job's --recordings, without a folder");
            return source;
        }
    }

    /** The timestamps of records. */
    public enum Stamps implements Coded {
        /** The original event time plus an offset that grows with each seek back. */
        ORIGINAL,
        /** The time at which the event is played. */
        NOW;
    }

    private static final class GapToText extends StdConverter<Long, String> {
        @Override
        public String convert(Long millis) {
            return Duration.ofMillis(millis).toString();
        }
    }

    /** Omits original timestamps, the default. */
    private static final class StampsToText extends StdConverter<Stamps, String> {
        @Override
        public String convert(Stamps stamps) {
            return stamps == Stamps.ORIGINAL ? null : stamps.code();
        }
    }

    public ReplayPlan {
        devices = List.copyOf(devices);
        analytics = List.copyOf(analytics);
    }

    static ReplayPlan read(JsonObjectReader members) throws RejectedException {
        Instant from = members.timeOrNull("from");
        Instant to = members.timeOrNull("to");
        JsonObjectReader.refuseIf(from != null && to != null && !from.isBefore(to), "to", "after 'from'");
        ObjectNode source = members.objectOrNull("source");
        Duration maxGap = members.durationOrNull("maxGap");
        List<String> analytics = members.texts("analytics", Pattern.compile("[a-z]{1,20}"), "analytics jobs");
        JsonObjectReader.refuseIf(
                !AnalyticsKind.jobNames().containsAll(analytics),
                "analytics",
                "a list of " + String.join(", ", AnalyticsKind.jobNames()));
        return new ReplayPlan(
                source == null ? null : Source.read(source),
                millis(from),
                millis(to),
                members.flag("loop"),
                members.texts("devices", DeviceGroup.ENTITY_ID, "entity ids"),
                maxGap == null ? null : Long.valueOf(maxGap.toMillis()),
                stamps(members),
                millis(members.timeOrNull("startAt")),
                analytics.stream().distinct().sorted().toList());
    }

    private static Stamps stamps(JsonObjectReader members) throws RejectedException {
        String word = members.textOrNull("stamps");
        return word == null
                ? Stamps.ORIGINAL
                : Coded.find(Stamps.values(), word)
                        .orElseThrow(() -> JsonObjectReader.wrong("stamps", "original or now"));
    }

    private static Long millis(Instant time) {
        return time == null ? null : Long.valueOf(time.toEpochMilli());
    }

    /** Returns the plan between other times. */
    public ReplayPlan between(long newFrom, long newTo) {
        return new ReplayPlan(source, newFrom, newTo, loop, devices, maxGap, stamps, startAt, analytics);
    }
}
