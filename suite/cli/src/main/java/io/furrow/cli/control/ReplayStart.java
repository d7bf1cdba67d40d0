package io.furrow.cli.control;

import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;

import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.time.TimeConverter;
import io.furrow.model.result.AnalyticsKind;
import io.furrow.model.topic.Topics;

/** The request and the commands of {@code ./furrow replay start}. */
final class ReplayStart {
    @Parameters(
            arity = "0..*",
            paramLabel = "MISSION",
            description = "Name of the mission; several are played as a group with one clock.")
    private List<String> named = List.of();

    @Option(
            names = "--mission",
            paramLabel = "NAME",
            split = ",",
            hideParamSyntax = true,
            description = "The same as an option; may be repeated.")
    private List<String> missions = List.of();

    @Option(
            names = "--topic",
            paramLabel = "TOPIC",
            description =
                    "Topic to play on, data.NAME.replay.<8 hexadecimal digits>. Default: named after the mission.")
    private String topic;

    @Option(
            names = "--from",
            paramLabel = "TIME",
            description = "Event time of the first event: " + TimeConverter.FORMS)
    private Instant from;

    @Option(
            names = "--to",
            paramLabel = "TIME",
            description = "Event time after the last event: " + TimeConverter.FORMS)
    private Instant to;

    @Option(names = "--speed", paramLabel = "X", description = "0.1 to 1000, or max. Default: 1.")
    private String speed;

    @Option(names = "--loop", description = "Start again at the end.")
    private boolean loop;

    @Option(names = "--range", paramLabel = "A..B", description = "Repeat the range between these event times.")
    private String range;

    @Option(
            names = {"--device", "--devices"},
            paramLabel = "ID",
            split = ",",
            description = "Ids of the entities to play back, separated by commas. Default: all.")
    private List<String> devices;

    @Option(
            names = "--max-gap",
            paramLabel = "DURATION",
            description = "Shorten pauses without events to this, for instance 30s. Default: original pauses.")
    private Duration maxGap;

    @Option(
            names = "--stamps",
            paramLabel = "WHICH",
            description =
                    "Timestamps of records: original, or now, the time at which an event is played. Default: original.")
    private String stamps;

    @Option(
            names = {"--at", "--start-at"},
            paramLabel = "TIME",
            converter = TimeConverter.Next.class,
            description = "Wall-clock time of the first event, as 06:00 or +2h. Default: at once.")
    private Instant startAt;

    @Option(
            names = "--analytics",
            paramLabel = "JOB",
            split = ",",
            completionCandidates = JobNames.class,
            description = "Analytics jobs to run on the replay, separated by commas: ${COMPLETION-CANDIDATES}.")
    private List<String> analytics;

    @Option(
            names = "--kafka",
            paramLabel = "HOST:PORT",
            description =
                    "Kafka as the Flink cluster reaches it, for the printed commands that start analytics jobs there. "
                            + "Default: none, so the jobs use 127.0.0.1:9092.")
    private String kafka;

    @Option(
            names = "--source-topic",
            paramLabel = "TOPIC",
            description = "Play the history of this topic instead of the mission in MongoDB.")
    private String sourceTopic;

    @Option(
            names = "--source-file",
            paramLabel = "FILE",
            description = "Play this file of the job's --recordings, instead of the mission in MongoDB.")
    private String sourceFile;

    /** The body of the request. */
    ObjectNode body(ControlOptions control) {
        List<String> all = new ArrayList<>(named);
        all.addAll(missions);
        if (all.isEmpty()) {
            throw control.refused("Name a mission, or several for a group: MISSION, or --mission NAME");
        } else if (sourceTopic != null && sourceFile != null) {
            throw control.refused("Name one of --source-topic and --source-file");
        }
        Map<String, Object> members = new LinkedHashMap<>();
        members.put(all.size() == 1 ? "mission" : "missions", all.size() == 1 ? all.get(0) : all);
        members.put("topic", topic);
        members.put("from", millis(from));
        members.put("to", millis(to));
        members.put("speed", speed == null ? null : ReplayArguments.speed(speed));
        members.put("loop", loop ? true : null);
        members.put("range", range == null ? null : range(control));
        members.put("devices", devices);
        members.put("maxGap", maxGap == null ? null : maxGap.toString());
        members.put("stamps", stamps);
        members.put("startAt", millis(startAt));
        members.put("analytics", analytics);
        if (sourceTopic != null || sourceFile != null) {
            members.put("source", sourceTopic == null ? Map.of("file", sourceFile) : Map.of("topic", sourceTopic));
        }
        return ControlOptions.object(members);
    }

    private Map<String, Long> range(ControlOptions control) {
        String[] ends = range.split("\\.\\.", -1);
        if (ends.length != 2 || ends[0].isBlank() || ends[1].isBlank()) {
            throw control.refused("--range '%s' is not A..B, two event times".formatted(range));
        }
        return ReplayArguments.range(control, ends[0], ends[1]);
    }

    private static Long millis(Instant time) {
        return time == null ? null : Long.valueOf(time.toEpochMilli());
    }

    /**
     * The commands that start the analytics jobs on a cluster; empty without {@code --analytics}.
     *
     * @param answer of the control plane: {@code topic} of one replay, or {@code replays} of a group
     */
    List<String> commands(JsonNode answer) {
        if (analytics == null) {
            return List.of();
        }
        List<String> topics = new ArrayList<>();
        if (answer.hasNonNull("topic")) {
            topics.add(answer.path("topic").asText());
        }
        answer.path("replays").forEach(replay -> {
            String name = replay.asText();
            int dot = name.lastIndexOf('.');
            topics.add(Topics.replay(name.substring(0, dot), name.substring(dot + 1)));
        });
        return topics.stream()
                .flatMap(one -> analytics.stream().map(job -> new ReplayAnalyticsJob(job, one)))
                .map(job -> "flink run -d furrow-analytics-*-job.jar %s %s%s"
                        .formatted(
                                job.job(), String.join(" ", job.options()), kafka == null ? "" : " --kafka " + kafka))
                .toList();
    }

    static final class JobNames extends ArrayList<String> {
        private static final long serialVersionUID = 1;

        JobNames() {
            super(AnalyticsKind.jobNames());
        }
    }
}
