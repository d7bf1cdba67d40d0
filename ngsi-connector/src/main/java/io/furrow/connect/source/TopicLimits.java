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

/**
 * Knows the {@code max.message.bytes} of topics, where it may ask Kafka: at the start, and every minute while records are sent. Not
 * knowing is no failure: what it was told last is true until it is told otherwise.
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
     * Asks for the first time, and waits some seconds for the answer.
     *
     * @param settings of an admin client; without {@code bootstrap.servers} nobody is asked, and nothing known
     * @param client name of it
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

    /** Bytes of the largest batch of records that the topic takes; {@link #UNKNOWN} where it may not exist yet, or nobody was asked. */
    long of(String topic) {
        return limits.getOrDefault(topic, UNKNOWN);
    }

    /** Asks again if the last time is long ago; waits for nothing. */
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
                    "Kafka does not say how large a record topic {} takes: {}; a larger one would stop the task. Look at"
                            + " {}*, and let its user describe the configuration of topics",
                    topic,
                    failure,
                    SizeOptions.ADMIN_PREFIX);
        }
    }

    private void await(KafkaFuture<Void> answers) {
        try {
            answers.get(FIRST_ANSWER.toMillis(), TimeUnit.MILLISECONDS);
        } catch (ExecutionException | TimeoutException e) {
            LOG.debug("goes on without an answer, which may come later", e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    @Override
    public void close() {
        admin.ifPresent(client -> client.close(Duration.ZERO));
    }
}
