package io.furrow.flink;

import java.io.IOException;
import java.time.Duration;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.ExecutionException;
import java.util.function.LongSupplier;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.AdminClientConfig;
import org.apache.kafka.clients.admin.Config;
import org.apache.kafka.common.config.ConfigResource;
import org.apache.kafka.common.config.TopicConfig;
import org.apache.kafka.common.errors.AuthorizationException;
import org.apache.kafka.common.errors.TopicExistsException;
import org.apache.kafka.common.errors.UnknownTopicOrPartitionException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * The topics that a subtask writes to: made where they are not there, and how large a record each takes. Asks once per topic;
 * an unreachable broker is asked again for a minute.
 */
final class OutputTopics implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(OutputTopics.class);
    private static final Duration PATIENCE = Duration.ofMinutes(1);
    /** A limit is asked for anew at most this often, however many records are too large. */
    private static final long ANEW_NANOS = Duration.ofSeconds(10).toNanos();

    private static final Limit NO_LIMIT = new Limit(Long.MAX_VALUE, 0);
    private static final String UNREADABLE =
            "How large records {} takes may not be read: one that is too large will fail the job. Allow DescribeConfigs on "
                    + "the topic, or set max.request.size in --kafka-properties";

    private final Properties client;
    private final TopicOptions.Settings settings;
    private final LongSupplier nanoTime;
    private final Map<String, Limit> known = new HashMap<>();
    private Admin admin;

    private record Limit(long bytes, long asked) {}

    /** @param client of Kafka, with {@code bootstrap.servers} */
    OutputTopics(Properties client, TopicOptions.Settings settings) {
        this(client, settings, System::nanoTime);
    }

    OutputTopics(Properties client, TopicOptions.Settings settings, LongSupplier nanoTime) {
        this.nanoTime = nanoTime;
        this.settings = settings;
        this.client = client;
        client.setProperty(AdminClientConfig.DEFAULT_API_TIMEOUT_MS_CONFIG, Long.toString(PATIENCE.toMillis()));
    }

    /** Bytes of the largest record that the topic, which is there afterwards, takes; no limit where it may not be read. */
    long limit(String topic) throws IOException, InterruptedException {
        if (!known.containsKey(topic)) {
            ensure(topic);
            ask(topic);
        }
        return known.getOrDefault(topic, NO_LIMIT).bytes();
    }

    /** The same for whoever has met the limit that is known: somebody may have raised it. */
    long limitAskedAnew(String topic) throws IOException, InterruptedException {
        Limit limit = known.get(topic);
        if (limit != null && nanoTime.getAsLong() - limit.asked() > ANEW_NANOS) {
            ask(topic);
        }
        return limit(topic);
    }

    private void ensure(String topic) throws IOException, InterruptedException {
        try {
            admin().createTopics(List.of(settings.topic(topic))).all().get();
            LOG.info("Made topic {}", topic);
        } catch (ExecutionException e) {
            if (!(e.getCause() instanceof TopicExistsException) && !isAllowedOnlyToWrite(topic, e.getCause())) {
                throw new IOException(
                        "topic " + topic + " could not be made: " + e.getCause().getMessage()
                                + "; see --topic-partitions, --topic-replication, --topic-retention, or make it yourself",
                        e.getCause());
            }
        }
    }

    /** Who may not make topics may still write to those that others made. */
    private boolean isAllowedOnlyToWrite(String topic, Throwable refusal) throws InterruptedException {
        if (!(refusal instanceof AuthorizationException)) {
            return false;
        }
        try {
            admin().describeTopics(List.of(topic)).allTopicNames().get();
            return true;
        } catch (ExecutionException e) {
            LOG.warn("Topic {} is not there, or may not be seen", topic, e.getCause());
            return false;
        }
    }

    private void ask(String topic) throws IOException, InterruptedException {
        ConfigResource resource = new ConfigResource(ConfigResource.Type.TOPIC, topic);
        long asked = nanoTime.getAsLong();
        try {
            Config config =
                    admin().describeConfigs(List.of(resource)).all().get().get(resource);
            String bytes = config.get(TopicConfig.MAX_MESSAGE_BYTES_CONFIG).value();
            known.put(topic, new Limit(Long.parseLong(bytes), asked));
        } catch (ExecutionException e) {
            if (e.getCause() instanceof AuthorizationException) {
                LOG.warn(UNREADABLE, topic, e.getCause());
                known.put(topic, NO_LIMIT);
                return;
            }
            if (e.getCause() instanceof UnknownTopicOrPartitionException) {
                return; // made just now, this broker has not heard of it: the next record asks again
            }
            throw new IOException(
                    "how large records " + topic + " takes cannot be read: "
                            + e.getCause().getMessage(),
                    e.getCause());
        }
    }

    private Admin admin() {
        if (admin == null) {
            admin = Admin.create(client);
        }
        return admin;
    }

    @Override
    public void close() {
        if (admin != null) {
            admin.close(Duration.ofSeconds(1));
        }
    }
}
