package io.furrow.flink.kafka;

import java.io.Serializable;
import java.time.Duration;
import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.common.config.TopicConfig;
import picocli.CommandLine.Option;

import io.furrow.flink.job.CountConverter;
import io.furrow.model.topic.Topics;

/** Options for creating missing topics that a job writes to; existing ones stay unchanged. */
public final class TopicOptions {
    @Option(
            names = "--topic-partitions",
            paramLabel = "N",
            converter = CountConverter.class,
            description = "Partitions of topics that the job creates. Default: the broker's num.partitions.")
    private Integer partitions;

    @Option(
            names = "--topic-replication",
            paramLabel = "N",
            converter = CountConverter.class,
            description = "Replicas of topics that the job creates. Default: the broker's default.replication.factor.")
    private Integer replication;

    @Option(
            names = "--topic-retention",
            paramLabel = "DURATION",
            description = "Retention of topics that the job creates, except compacted ones. Default: the broker's "
                    + "log.retention.")
    private Duration retention;

    /** The settings without picocli, because they are serialized with the job. */
    public Settings settings(Set<String> compacted) {
        return new Settings(
                partitions,
                replication == null ? null : replication.shortValue(),
                retention == null ? null : retention.toMillis(),
                compacted,
                null);
    }

    /**
     * @param partitions null for the broker's default, like {@code replication} and {@code retentionMillis}
     * @param compacted topics that retain the newest record of each key forever
     * @param replayBytes of a partition of a replay's topic or of one of its results, which are bounded by size instead of time:
     *     their records have past or future timestamps; null for unbounded
     */
    public record Settings(
            Integer partitions, Short replication, Long retentionMillis, Set<String> compacted, Long replayBytes)
            implements Serializable {
        /**
         * The active segment is not compacted, and readers of a state read all of it: by default a week of events. A
         * segment must hold the largest record.
         */
        private static final int COMPACTED_SEGMENT_BYTES = 2 * KafkaConnectors.MAX_REQUEST_BYTES;

        private static final Duration COMPACTED_SEGMENT = Duration.ofMinutes(5);

        public Settings(Integer partitions, Short replication, Long retentionMillis, Set<String> compacted) {
            this(partitions, replication, retentionMillis, compacted, null);
        }

        /** The same with a limit for each partition of a replay's topic. */
        public Settings withReplayBytes(long bytes) {
            return new Settings(partitions, replication, retentionMillis, compacted, bytes);
        }

        /** The topic to create; it accepts records as large as the job may write. */
        NewTopic topic(String name) {
            Map<String, String> configs = new HashMap<>();
            configs.put(TopicConfig.MAX_MESSAGE_BYTES_CONFIG, Integer.toString(KafkaConnectors.MAX_REQUEST_BYTES));
            if (compacted.contains(name)) {
                configs.put(TopicConfig.CLEANUP_POLICY_CONFIG, TopicConfig.CLEANUP_POLICY_COMPACT);
                configs.put(TopicConfig.SEGMENT_BYTES_CONFIG, Integer.toString(COMPACTED_SEGMENT_BYTES));
                configs.put(TopicConfig.SEGMENT_MS_CONFIG, Long.toString(COMPACTED_SEGMENT.toMillis()));
            } else if (Topics.isOfReplay(name)) {
                configs.put(TopicConfig.RETENTION_MS_CONFIG, "-1");
                configs.put(TopicConfig.MESSAGE_TIMESTAMP_AFTER_MAX_MS_CONFIG, Long.toString(Long.MAX_VALUE));
                if (replayBytes != null) {
                    configs.put(TopicConfig.RETENTION_BYTES_CONFIG, Long.toString(replayBytes));
                }
            } else if (retentionMillis != null) {
                configs.put(TopicConfig.RETENTION_MS_CONFIG, Long.toString(retentionMillis));
            }
            return new NewTopic(name, Optional.ofNullable(partitions), Optional.ofNullable(replication))
                    .configs(configs);
        }
    }
}
