package io.furrow.flink.kafka;

import java.io.IOException;
import java.time.Duration;
import java.util.Collection;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ExecutionException;
import java.util.function.LongSupplier;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.AdminClientConfig;
import org.apache.kafka.clients.admin.Config;
import org.apache.kafka.clients.admin.TopicDescription;
import org.apache.kafka.common.KafkaFuture;
import org.apache.kafka.common.config.ConfigResource;
import org.apache.kafka.common.config.TopicConfig;
import org.apache.kafka.common.errors.AuthorizationException;
import org.apache.kafka.common.errors.TopicExistsException;
import org.apache.kafka.common.errors.UnknownTopicOrPartitionException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.text.FailureText;

/**
 * The topics that a subtask writes to: creates missing ones and reads their limits of record size. Queries each topic once, and again after
 * a pause in which it may have been deleted; with an unreachable broker it retries for a minute. Queries of different topics do not wait
 * for each other.
 */
final class OutputTopics implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(OutputTopics.class);
    private static final Duration TIMEOUT = Duration.ofMinutes(1);
    /** Minimum time between queries of a limit, however many records are too large. */
    private static final long ANEW_NANOS = Duration.ofSeconds(10).toNanos();

    /**
     * A producer that writes to a deleted topic waits for a minute and fails; the control plane deletes no topic written to within this
     * time.
     */
    private static final long UNUSED_NANOS = Duration.ofMinutes(5).toNanos();

    private static final Duration UNHEARD_OF = Duration.ofMillis(50);
    private static final Limit NO_LIMIT = new Limit(Long.MAX_VALUE, 0);
    private static final String UNREADABLE =
            "How large records {} takes may not be read: one that is too large will fail the job. Allow DescribeConfigs on "
                    + "the topic, or set max.request.size in --kafka-properties";

    private final Properties client;
    private final TopicOptions.Settings settings;
    private final LongSupplier nanoTime;
    private final Map<String, Limit> known = new ConcurrentHashMap<>();
    /** The time of the last record by topic. */
    private final Map<String, Long> used = new ConcurrentHashMap<>();
    /** Lock by topic, held during a query. */
    private final Map<String, Object> locks = new ConcurrentHashMap<>();

    private Admin admin;

    private record Limit(long bytes, long asked) {}

    /** @param client settings of Kafka clients, with {@code bootstrap.servers} */
    OutputTopics(Properties client, TopicOptions.Settings settings) {
        this(client, settings, System::nanoTime);
    }

    OutputTopics(Properties client, TopicOptions.Settings settings, LongSupplier nanoTime) {
        this.nanoTime = nanoTime;
        this.settings = settings;
        this.client = client;
        client.setProperty(AdminClientConfig.DEFAULT_API_TIMEOUT_MS_CONFIG, Long.toString(TIMEOUT.toMillis()));
    }

    /** Bytes of the largest record that the topic accepts, after creating it if missing; unlimited if the limit may not be read. */
    long limit(String topic) throws IOException, InterruptedException {
        long now = nanoTime.getAsLong();
        Long before = used.put(topic, now);
        if (before != null && now - before >= UNUSED_NANOS) {
            known.remove(topic);
        }
        if (!known.containsKey(topic)) {
            require(topic);
        }
        return known.getOrDefault(topic, NO_LIMIT).bytes();
    }

    /** The same without the cache, for a record above the cached limit: it may have been raised. */
    long limitAskedAnew(String topic) throws IOException, InterruptedException {
        Limit limit = known.get(topic);
        if (limit != null && nanoTime.getAsLong() - limit.asked() > ANEW_NANOS) {
            ask(topic);
        }
        return limit(topic);
    }

    private void require(String topic) throws IOException, InterruptedException {
        synchronized (lock(topic)) {
            if (!known.containsKey(topic)) {
                ensure(topic);
                ask(topic);
            }
        }
    }

    private Object lock(String topic) {
        return locks.computeIfAbsent(topic, any -> new Object());
    }

    /**
     * The number of partitions of the topic, after creating it if missing and caching its limit. Retries while a broker has no metadata of
     * a new topic.
     */
    int partitions(String topic) throws IOException, InterruptedException {
        synchronized (lock(topic)) {
            require(topic);
            long until = nanoTime.getAsLong() + TIMEOUT.toNanos();
            while (true) {
                int partitions = describe(topic, until);
                if (partitions == 0) {
                    ensure(topic); // it may have been deleted since its creation
                }
                if (partitions > 0 && !known.containsKey(topic)) {
                    ask(topic);
                }
                if (partitions > 0 && (known.containsKey(topic) || nanoTime.getAsLong() > until)) {
                    return partitions;
                }
                Thread.sleep(UNHEARD_OF.toMillis());
            }
        }
    }

    /** 0 if the broker has no metadata of the topic by a time. */
    private int describe(String topic, long until) throws IOException, InterruptedException {
        try {
            return admin().describeTopics(List.of(topic))
                    .allTopicNames()
                    .get()
                    .get(topic)
                    .partitions()
                    .size();
        } catch (ExecutionException e) {
            boolean unknown = e.getCause() instanceof UnknownTopicOrPartitionException;
            if (!unknown || nanoTime.getAsLong() > until) {
                throw new IOException(
                        "the partitions of " + topic + " cannot be read: " + FailureText.of(e.getCause())
                                + "; is the topic there, and may the job describe it?",
                        e.getCause());
            }
            return 0;
        }
    }

    /** The broker's ids of the existing topics: a recreated topic has another. */
    Map<String, String> ids(Collection<String> topics) throws IOException, InterruptedException {
        Map<String, String> ids = new HashMap<>();
        for (Map.Entry<String, KafkaFuture<TopicDescription>> each :
                admin().describeTopics(topics).topicNameValues().entrySet()) {
            try {
                ids.put(each.getKey(), each.getValue().get().topicId().toString());
            } catch (ExecutionException e) {
                if (!(e.getCause() instanceof UnknownTopicOrPartitionException)) {
                    throw new IOException(
                            "topic " + each.getKey() + " cannot be described: " + FailureText.of(e.getCause()),
                            e.getCause());
                }
            }
        }
        return ids;
    }

    private void ensure(String topic) throws IOException, InterruptedException {
        try {
            admin().createTopics(List.of(settings.topic(topic))).all().get();
            LOG.info("Created topic {}", topic);
        } catch (ExecutionException e) {
            if (!(e.getCause() instanceof TopicExistsException) && !isAllowedOnlyToWrite(topic, e.getCause())) {
                throw new IOException(
                        "topic " + topic + " could not be made: " + FailureText.of(e.getCause())
                                + "; see --topic-partitions, --topic-replication, --topic-retention, or make it yourself",
                        e.getCause());
            }
        }
    }

    /** A client without permission to create topics may still write to existing ones. */
    private boolean isAllowedOnlyToWrite(String topic, Throwable refusal) throws InterruptedException {
        if (!(refusal instanceof AuthorizationException)) {
            return false;
        }
        try {
            admin().describeTopics(List.of(topic)).allTopicNames().get();
            return true;
        } catch (ExecutionException e) {
            LOG.warn("Topic {} does not exist, or this user may not describe it", topic, e.getCause());
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
                return; // new, and unknown to this broker: the next record retries
            }
            throw new IOException(
                    "how large records " + topic + " takes cannot be read: " + FailureText.of(e.getCause()),
                    e.getCause());
        }
    }

    private synchronized Admin admin() {
        if (admin == null) {
            admin = Admin.create(client);
        }
        return admin;
    }

    @Override
    public synchronized void close() {
        if (admin != null) {
            admin.close(Duration.ofSeconds(1));
        }
    }
}
