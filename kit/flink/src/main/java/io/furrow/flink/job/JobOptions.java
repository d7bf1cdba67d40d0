package io.furrow.flink.job;

import java.io.IOException;
import java.io.Reader;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.TreeMap;
import java.util.regex.Pattern;
import java.util.regex.PatternSyntaxException;

import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Model.OptionSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

import io.furrow.model.topic.Topics;

/** The options of every job, parsed by picocli. Holds no Flink type, so that {@code --help} works without Flink on the class path. */
public abstract class JobOptions {
    /** User and password of a URI. */
    private static final Pattern CREDENTIALS = Pattern.compile("://[^/@]*@");

    private static final Pattern NAME = Pattern.compile("[A-Za-z0-9._-]{1,100}");

    @Spec
    private CommandSpec spec;

    @Option(
            names = "--name",
            paramLabel = "NAME",
            description =
                    "Name of this instance in the web UI, in its consumer group furrow-NAME and in its transactional "
                            + "ids. Concurrent instances need different names, and different output topics if their results "
                            + "differ. Default: the name of the job.")
    private String name;

    @Option(
            names = {"--kafka", "--bootstrap-servers"},
            paramLabel = "HOST:PORT,…",
            defaultValue = "127.0.0.1:9092",
            description = "Kafka brokers to start from. Default: ${DEFAULT-VALUE}.")
    private String bootstrapServers;

    @Option(
            names = "--kafka-properties",
            paramLabel = "FILE",
            description = "Properties for every Kafka client of the job, for instance security settings.")
    private Path kafkaProperties;

    @Option(
            names = "--input",
            paramLabel = "TOPIC,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "data.raw",
            description = "Topics to read, or regular expressions for whole names, for instance "
                    + "'data[.]north[.]realtime[.].*': then also topics that are created later, but no topics of dead "
                    + "letters or of analytics results. The topic of a replay is named in full and without others: each "
                    + "replay has its own instance, named <job>-<replay> without --name, whose results go to "
                    + "<topic>.<result>. Default: ${DEFAULT-VALUE}.")
    private List<String> input;

    @Option(
            names = "--from",
            paramLabel = "POSITION",
            defaultValue = "committed",
            description =
                    "Start position without a savepoint or checkpoint: committed, the offsets of the consumer group, "
                            + "else the beginning; earliest; latest; or a time as in 2026-05-01T06:00:00Z. Default: "
                            + "${DEFAULT-VALUE}.")
    private StartPosition from;

    @Option(
            names = "--delivery",
            paramLabel = "MODE",
            defaultValue = "at-least-once",
            description =
                    "at-least-once: visible at once; duplicates after a failure have the same event id. exactly-once: "
                            + "visible after each checkpoint. Default: ${DEFAULT-VALUE}.")
    private Delivery delivery;

    @Option(
            names = "--out-of-orderness",
            paramLabel = "DURATION",
            defaultValue = "2s",
            description =
                    "How much later than a newer event an older one may arrive without being late. Longer: fewer late "
                            + "events, later results. Default: ${DEFAULT-VALUE}.")
    private Duration outOfOrderness;

    @Option(
            names = "--idle-timeout",
            paramLabel = "DURATION",
            defaultValue = "10s",
            description =
                    "After this time without a record a partition does not hold back event time any more. Depends on the "
                            + "wall clock. Default: ${DEFAULT-VALUE}.")
    private Duration idleTimeout;

    @Option(
            names = "--idle-advance",
            description =
                    "Advance event time with the wall clock if no record has arrived for --idle-timeout, so that open "
                            + "windows and encounters end without further records, also after a restart. Records that arrive "
                            + "afterwards can be late: with this option alone the same input does not always give the same result.")
    private boolean idleAdvance;

    @Option(names = "--parallelism", paramLabel = "N", description = "Subtasks per operator. Default: the cluster's.")
    private Integer parallelism;

    @Mixin
    private final RecoveryOptions faults = new RecoveryOptions();

    @Mixin
    private final ClockOptions clocks = new ClockOptions();

    @Option(
            names = {"-h", "--help"},
            usageHelp = true,
            description = "Show this help.")
    private boolean help;

    /**
     * The name of this instance of the job, part of its consumer group and its transactional ids.
     *
     * @throws ParameterException if Kafka does not accept it
     */
    public String jobName() {
        if (name == null) {
            String ofReplay = inputTopics()
                    .replay()
                    .flatMap(Topics::replayOf)
                    .map(replay -> "-" + replay)
                    .orElse("");
            return defaultName() + ofReplay;
        }
        if (!NAME.matcher(name).matches()) {
            throw refused("--name '" + name + "' is not 1 to 100 of A-Z a-z 0-9 . _ -", null);
        }
        return name;
    }

    /** The default name of an instance. */
    protected String defaultName() {
        return spec.name();
    }

    /** Whether a name is configured. */
    boolean isNamed() {
        return name != null;
    }

    /** The consumer group of the job's input. */
    public String groupId() {
        return "furrow-" + jobName();
    }

    public String bootstrapServers() {
        return bootstrapServers;
    }

    /**
     * A fresh copy of the file of {@code --kafka-properties}; empty without it.
     *
     * @throws ParameterException if the file cannot be read
     */
    public Properties kafkaProperties() {
        Properties properties = new Properties();
        if (kafkaProperties == null) {
            return properties;
        }
        try (Reader reader = Files.newBufferedReader(kafkaProperties)) {
            properties.load(reader);
            return properties;
        } catch (IOException | IllegalArgumentException e) { // the latter: an invalid escape
            throw refused(
                    "--kafka-properties " + kafkaProperties + " cannot be read; name a readable properties file", e);
        }
    }

    /** The job's own defaults for its producers; {@code --kafka-properties} overrides them. */
    public Map<String, String> producerDefaults() {
        return Map.of();
    }

    public List<String> input() {
        return List.copyOf(input);
    }

    /** The input as topics or a pattern; rejects invalid names, and topics that share no event time. */
    public InputTopics inputTopics() {
        InputTopics topics = new InputTopics(input());
        try {
            topics.pattern();
            topics.refusal(spec.name()).ifPresent(why -> {
                throw refused("--input " + String.join(",", input()) + ": " + why, null);
            });
            return topics;
        } catch (PatternSyntaxException e) {
            throw refused("--input is neither a topic nor a regular expression: " + e.getMessage(), e);
        }
    }

    public StartPosition from() {
        return from;
    }

    public Delivery delivery() {
        return delivery;
    }

    public Duration outOfOrderness() {
        return outOfOrderness;
    }

    public Duration idleTimeout() {
        if (idleTimeout.isZero()) {
            throw refused("--idle-timeout must be longer than 0, for instance 10s", null);
        }
        return idleTimeout;
    }

    public boolean idleAdvance() {
        if (idleAdvance && inputTopics().replay().isPresent()) {
            throw refused("--idle-advance goes by the wall clock, and a replay does not; leave it out", null);
        }
        return idleAdvance;
    }

    /** At least 10 ms, Flink's own limit; empty if the cluster decides. */
    Optional<Duration> checkpointInterval() {
        Optional<Duration> interval = faults.checkpointInterval();
        if (interval.filter(time -> time.toMillis() < 10).isPresent()) {
            throw refused("--checkpoint-interval is below 10ms; write for instance 1s", null);
        }
        return interval;
    }

    /** The tolerated clock skew. */
    public ClockOptions clocks() {
        return clocks;
    }

    /** The options for checkpoints and restarts. */
    RecoveryOptions faults() {
        return faults;
    }

    Optional<String> checkpointDir() {
        return faults.checkpointDir();
    }

    /** Between 1 and 720, the number of key groups. */
    public Optional<Integer> parallelism() {
        if (parallelism != null && (parallelism < 1 || parallelism > 720)) {
            throw refused(
                    "--parallelism " + parallelism + " is not between 1 and 720; leave it out or name another", null);
        }
        return Optional.ofNullable(parallelism);
    }

    /**
     * Every option with its effective value as on the command line, without passwords in addresses; the web UI shows it as
     * the job's configuration.
     */
    Map<String, String> effective() {
        Map<String, String> values = new TreeMap<>();
        for (OptionSpec option : spec.options()) {
            if (!option.usageHelp() && option.getValue() != null) {
                List<String> given = option.originalStringValues();
                String text = given.isEmpty() ? option.defaultValueString() : String.join(",", given);
                if (text != null) { // null: a repeatable option without a value
                    values.put(option.names()[0], masked(text));
                }
            }
        }
        return values;
    }

    /** Removes passwords in addresses. */
    static String masked(String text) {
        return CREDENTIALS.matcher(text).replaceAll("://***@");
    }

    /** A wrong setting: the message names the option and the remedy. */
    protected ParameterException refused(String message, Throwable cause) {
        return new ParameterException(spec.commandLine(), message, cause);
    }
}
