package io.furrow.replay;

import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.UUID;

import com.fasterxml.jackson.databind.node.TextNode;
import org.apache.kafka.clients.CommonClientConfigs;
import org.apache.kafka.clients.producer.ProducerConfig;
import picocli.CommandLine.Command;
import picocli.CommandLine.IModelTransformer;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Model.OptionSpec;
import picocli.CommandLine.Option;

import io.furrow.flink.job.JobOptions;
import io.furrow.flink.job.WithoutEventTime;
import io.furrow.flink.kafka.TopicOptions;
import io.furrow.mission.PageLimits;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.MongoRecordings;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.time.Instants;
import io.furrow.model.topic.TopicName;
import io.furrow.model.topic.Topics;
import io.furrow.replay.recording.JobRecordings;
import io.furrow.replay.recording.RecordingSources;
import io.furrow.replay.recording.TopicHistories;
import io.furrow.replay.source.DesiredReplays;
import io.furrow.replay.source.ReplaysTopic;

/** The options of the job {@code replay}. */
@Command(
        name = "replay",
        description = "Plays stored missions back, each replay of service.replays on its own topic"
                + " data.<mission>.replay.<id>; with --once one mission, once.",
        modelTransformer = ReplayOptions.OwnOptions.class)
public final class ReplayOptions extends JobOptions {
    private static final int ID_DIGITS = 8;

    @Mixin
    private final TopicOptions topics = new TopicOptions();

    @Option(
            names = "--mongo",
            paramLabel = "URI",
            required = true,
            description = "MongoDB that holds the missions, for instance mongodb://127.0.0.1:27017. "
                    + "@FILE reads the URI, and so its password, from a file.")
    private String mongo;

    @Option(
            names = "--mongo-database",
            paramLabel = "NAME",
            defaultValue = "persistence",
            description = "Its database. Default: ${DEFAULT-VALUE}.")
    private String database;

    @Option(
            names = "--mongo-timeout",
            paramLabel = "DURATION",
            defaultValue = "5s",
            description =
                    "How long a replay waits for MongoDB before its status reports it; it retries as long as the replay "
                            + "is desired. Default: ${DEFAULT-VALUE}.")
    private Duration timeout;

    @Option(
            names = "--page-events",
            paramLabel = "N",
            defaultValue = "1000",
            description =
                    "Maximum number of events per read; each replay holds two such pages. A replay that is not at speed "
                            + "max reads the events of two seconds, at least 32. Default: ${DEFAULT-VALUE}.")
    private int pageEvents;

    @Option(
            names = "--page-bytes",
            paramLabel = "N",
            defaultValue = "4194304",
            description =
                    "Approximate maximum of bytes per read; less if the replays of a reader together hold about 64 MiB "
                            + "of heap. Default: ${DEFAULT-VALUE}.")
    private int pageBytes;

    @Option(
            names = "--recordings",
            paramLabel = "URI",
            description =
                    "Folder of exported missions, for instance s3://bucket/missions: replays may use its files as their "
                            + "source. Default: none.")
    private String folder;

    @Option(
            names = "--replay-topic-bytes",
            paramLabel = "N",
            defaultValue = "1073741824",
            description =
                    "retention.bytes per partition of the topics of replays; Kafka deletes the oldest records beyond it. "
                            + "Their retention.ms is -1. Default: ${DEFAULT-VALUE}.")
    private long topicBytes;

    @Option(names = "--once", description = "Play one mission and end, regardless of service.replays; needs --mission.")
    private boolean once;

    @Option(names = "--mission", paramLabel = "NAME", description = "With --once: the mission.")
    private String mission;

    @Option(
            names = "--source-topic",
            paramLabel = "NAME",
            description = "With --once: play the history of this topic, data.…, instead of a mission in MongoDB.")
    private String sourceTopic;

    @Option(
            names = "--source-file",
            paramLabel = "NAME",
            description = "With --once: play this file of --recordings instead of a mission in MongoDB.")
    private String sourceFile;

    @Option(
            names = OwnOptions.BEGIN,
            paramLabel = "TIME",
            description = "With --once: event time of the first event, ISO 8601. Default: that of the mission.")
    private String begin;

    @Option(
            names = "--to",
            paramLabel = "TIME",
            description = "With --once: event time after the last event, ISO 8601. Default: the mission's end.")
    private String end;

    @Option(
            names = "--speed",
            paramLabel = "X",
            defaultValue = "1",
            description = "With --once: 0.1 to 1000, or max. Default: ${DEFAULT-VALUE}.")
    private String speed;

    @Option(
            names = "--topic",
            paramLabel = "NAME",
            description =
                    "With --once: data.<mission>.replay.<eight hexadecimal digits>. Default: a topic with new digits.")
    private String topic;

    /** Removes the options of event time and input; {@code --from} is that of a mission. */
    static final class OwnOptions implements IModelTransformer {
        /** A temporary name, until the inherited option {@code --from} is removed. */
        private static final String BEGIN = "--mission-from";

        @Override
        public CommandSpec transform(CommandSpec spec) {
            new WithoutEventTime().transform(spec);
            spec.remove(spec.findOption("--input"));
            spec.remove(spec.findOption("--from"));
            OptionSpec begin = spec.findOption(BEGIN);
            spec.remove(begin);
            return spec.addOption(OptionSpec.builder(begin).names("--from").build());
        }
    }

    @Override
    public List<String> input() {
        return List.of(Topics.REPLAYS);
    }

    /**
     * Sends records of many topics without delay. Each partition allocates a whole batch of the producer's memory, so
     * batches are small. The first record of a topic waits for its metadata and delays all other records; the retry
     * backoff bounds how often the producer asks for them.
     */
    @Override
    public Map<String, String> producerDefaults() {
        return Map.of(
                ProducerConfig.BATCH_SIZE_CONFIG, "16384",
                ProducerConfig.LINGER_MS_CONFIG, "0",
                ProducerConfig.RETRY_BACKOFF_MS_CONFIG, "5");
    }

    public TopicOptions topics() {
        return topics;
    }

    boolean isOnce() {
        return once;
    }

    long topicBytes() {
        return topicBytes;
    }

    PageLimits pages() {
        if (pageEvents < 1 || pageBytes < 1) {
            throw refused("--page-events and --page-bytes must be at least 1; omit them or give greater values", null);
        }
        return new PageLimits(pageEvents, pageBytes);
    }

    /** Returns the missions of MongoDB, and files and topics for replays that name one. */
    RecordingSources recordings() {
        Properties kafka = kafkaProperties();
        kafka.setProperty(CommonClientConfigs.BOOTSTRAP_SERVERS_CONFIG, bootstrapServers());
        try {
            return new JobRecordings(new MongoRecordings(mongo, database, timeout), folder, TopicHistories.of(kafka));
        } catch (IllegalArgumentException e) {
            throw refused(
                    "--mongo is not an address of MongoDB (%s); write for instance mongodb://127.0.0.1:27017"
                            .formatted(MongoAccess.fault(mongo, e)),
                    e);
        }
    }

    /** Returns the replays of {@code service.replays}, or the one that these options describe. */
    DesiredReplays desired() {
        if (!once) {
            return new ReplaysTopic(this);
        }
        if (mission == null) {
            throw refused("--once has no mission; add --mission NAME", null);
        }
        if (!TopicName.isLegal(mission)) {
            throw refused("--mission %s is not a name: it takes 1 to 64 of A-Z a-z 0-9 _ -".formatted(mission), null);
        }
        String id8 = UUID.randomUUID().toString().substring(0, ID_DIGITS);
        String topicName = topic == null ? Topics.replay(mission, id8) : topic;
        String digits = topicName.substring(Math.max(0, topicName.length() - ID_DIGITS));
        if (!Topics.replay(mission, digits).equals(topicName) || !Topics.isReplay(topicName)) {
            throw refused(
                    "--topic %s is not a topic of a replay of this mission; write for instance %s"
                            .formatted(topicName, Topics.replay(mission, id8)),
                    null);
        }
        String replay = mission + "." + digits;
        ReplayPlan plan = new ReplayPlan(
                source(),
                time("--from", begin).orElse(null),
                time("--to", end).orElse(null),
                false,
                List.of(),
                null,
                ReplayPlan.Stamps.ORIGINAL,
                null,
                List.of());
        DesiredReplay desired = DesiredReplay.started(mission, topicName, plan, speed(), System.currentTimeMillis(), 0);
        return new DesiredReplays.One(replay, desired.toBytes());
    }

    private ReplayPlan.Source source() {
        if (sourceTopic != null && sourceFile != null) {
            throw refused("--source-topic and --source-file are both given; leave one out", null);
        }
        return sourceTopic == null && sourceFile == null ? null : new ReplayPlan.Source(sourceTopic, sourceFile);
    }

    private Optional<Long> time(String option, String text) {
        if (text == null) {
            return Optional.empty();
        }
        Optional<Instant> time = Instants.of(TextNode.valueOf(text));
        if (time.isEmpty()) {
            throw refused(option + " " + text + " is not a time; write for instance 2026-05-01T06:00:00Z", null);
        }
        return time.map(Instant::toEpochMilli);
    }

    private double speed() {
        if (speed.equals("max")) {
            return ReplayCommand.MAX;
        }
        try {
            double number = Double.parseDouble(speed);
            if (number >= 0.1 && number <= 1000) {
                return number;
            }
        } catch (NumberFormatException e) {
            throw refused("--speed " + speed + " is neither a number from 0.1 to 1000 nor max", e);
        }
        throw refused("--speed " + speed + " is neither a number from 0.1 to 1000 nor max", null);
    }
}
