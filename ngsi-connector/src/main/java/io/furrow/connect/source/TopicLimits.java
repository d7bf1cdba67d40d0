package io.furrow.connect.source;

import java.time.Duration;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.AdminClientConfig;
import org.apache.kafka.clients.admin.Config;
import org.apache.kafka.common.KafkaFuture;
import org.apache.kafka.common.config.ConfigResource;
import org.apache.kafka.common.config.TopicConfig;
import org.apache.kafka.common.errors.UnknownTopicOrPartitionException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.source.option.SizeOptions;

/**
 * Caches the {@code max.message.bytes} of topics: reads it from Kafka, if permitted, at the start and every minute
 * while records are sent. An unknown limit is no failure: the last known limit stays valid.
 */
final class TopicLimits implements AutoCloseable {
    static final long UNKNOWN = Long.MAX_VALUE;

    private static final Logger LOG = LoggerFactory.getLogger(TopicLimits.class);
    private static final Duration FIRST_ANSWER = Duration.ofSeconds(10);
    private static final Duration INTERVAL = Duration.ofMinutes(1);

    private final Optional<Admin> admin;
    private final List<ConfigResource> topics;
    private final Map<String, Long> limits = new ConcurrentHashMap<>();
    private volatile boolean reported;
    private long asked;

    private TopicLimits(Optional<Admin> admin, List<String> topics) {
        this.admin = admin;
        this.topics = topics.stream()
                .map(topic -> new ConfigResource(ConfigResource.Type.TOPIC, topic))
                .toList();
    }

    /**
     * Reads the limits for the first time and waits some seconds for the answer.
     *
     * @param settings of an admin client; without {@code bootstrap.servers} all limits stay unknown
     * @param client name of the client
     */
    static TopicLimits open(Map<String, Object> settings, String client, List<String> topics) {
        if (!settings.containsKey(AdminClientConfig.BOOTSTRAP_SERVERS_CONFIG)) {
            return new TopicLimits(Optional.empty(), topics);
        }
        Map<String, Object> all = new HashMap<>(settings);
        all.putIfAbsent(AdminClientConfig.CLIENT_ID_CONFIG, client);
        TopicLimits limits = new TopicLimits(Optional.of(Admin.create(all)), topics);
        limits.await(limits.ask());
        return limits;
    }

    /**
     * Bytes of the largest batch of records that the topic accepts; {@link #UNKNOWN} if the topic may not exist yet, or
     * the limits cannot be read.
     */
    long of(String topic) {
        return limits.getOrDefault(topic, UNKNOWN);
    }

    /** Reads the limits again if the last reading is too old; does not block. */
    void refresh() {
        if (admin.isPresent() && System.nanoTime() - asked > INTERVAL.toNanos()) {
            ask();
        }
    }

    private KafkaFuture<Void> ask() {
        asked = System.nanoTime();
        Map<ConfigResource, KafkaFuture<Config>> answers =
                admin.orElseThrow().describeConfigs(topics).values();
        answers.forEach(
                (topic, answer) -> answer.whenComplete((config, failure) -> note(topic.name(), config, failure)));
        return KafkaFuture.allOf(answers.values().toArray(KafkaFuture<?>[]::new));
    }

    private void note(String topic, Config config, Throwable failure) {
        if (failure == null) {
            limits.put(
                    topic,
                    Long.parseLong(
                            config.get(TopicConfig.MAX_MESSAGE_BYTES_CONFIG).value()));
            reported = false;
        } else if (failure instanceof UnknownTopicOrPartitionException) {
            limits.remove(topic);
        } else if (!reported) {
            reported = true;
            LOG.warn(
                    "cannot read max.message.bytes of topic {}: {}; a larger record would stop the task. Check {}*, and"
                            + " allow its user to describe the configuration of topics",
                    topic,
                    failure,
                    SizeOptions.ADMIN_PREFIX);
        }
    }

    private void await(KafkaFuture<Void> answers) {
        try {
            answers.get(FIRST_ANSWER.toMillis(), TimeUnit.MILLISECONDS);
        } catch (ExecutionException | TimeoutException e) {
            LOG.debug("continues without an answer, which may arrive later", e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    @Override
    public void close() {
        admin.ifPresent(client -> client.close(Duration.ZERO));
    }
}
