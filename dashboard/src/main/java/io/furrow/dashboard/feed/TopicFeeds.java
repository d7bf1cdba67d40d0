package io.furrow.dashboard.feed;

import java.time.Duration;
import java.util.Collection;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.Set;
import java.util.TreeSet;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.DescribeClusterOptions;
import org.apache.kafka.clients.admin.OffsetSpec;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.config.ConfigResource;
import org.apache.kafka.common.config.TopicConfig;
import org.apache.kafka.common.errors.InvalidTopicException;
import org.apache.kafka.common.errors.TopicAuthorizationException;
import org.apache.kafka.common.errors.UnknownTopicOrPartitionException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.dashboard.http.Problem;

/** Manages the feeds of all topics with streams; other topics are not read. */
public final class TopicFeeds implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(TopicFeeds.class);
    /** Time without an answer after which Kafka counts as unavailable. */
    static final Duration UNAVAILABLE_AFTER = Duration.ofSeconds(6);

    private static final long TIMEOUT_SECONDS = 5;

    private static final long TIME_TO_LIVE_NANOS = TimeUnit.SECONDS.toNanos(1);

    private final Properties client;
    private final StreamLimits limits;
    private final StreamCounters counters;
    private final Admin admin;
    private final Map<String, TopicFeed> feeds = new HashMap<>();
    private Map<String, Long> counts = Map.of();
    private long countedAt = System.nanoTime() - TIME_TO_LIVE_NANOS;
    private volatile long lastAnswer = System.nanoTime();
    private boolean closed;

    public TopicFeeds(Properties client, StreamLimits limits, StreamCounters counters) {
        this.client = client;
        this.limits = limits;
        this.counters = counters;
        this.admin = Admin.create(client);
    }

    /** @throws Problem 503 if Kafka does not respond */
    public Set<String> topics() {
        if (isKafkaUnavailable()) {
            throw unavailable();
        }
        try {
            Set<String> names = new TreeSet<>(admin.listTopics().names().get(TIMEOUT_SECONDS, TimeUnit.SECONDS));
            lastAnswer = System.nanoTime();
            return names;
        } catch (ExecutionException | TimeoutException e) {
            throw unavailable();
        } catch (InterruptedException e) {
            throw Problem.stopping();
        }
    }

    /**
     * The number of records ever written to each topic, by the end offsets of its partitions; cached for a second.
     *
     * @throws Problem 503 if Kafka does not respond
     */
    public synchronized Map<String, Long> written(Collection<String> names) {
        if (System.nanoTime() - countedAt < TIME_TO_LIVE_NANOS
                && counts.keySet().containsAll(names)) {
            return counts;
        }
        try {
            Map<TopicPartition, OffsetSpec> ends = new HashMap<>();
            admin.describeTopics(names).allTopicNames().get(TIMEOUT_SECONDS, TimeUnit.SECONDS).values().stream()
                    .flatMap(topic ->
                            topic.partitions().stream().map(each -> new TopicPartition(topic.name(), each.partition())))
                    .forEach(partition -> ends.put(partition, OffsetSpec.latest()));
            Map<String, Long> sums = new HashMap<>();
            admin.listOffsets(ends)
                    .all()
                    .get(TIMEOUT_SECONDS, TimeUnit.SECONDS)
                    .forEach((partition, end) -> sums.merge(partition.topic(), end.offset(), Long::sum));
            counts = sums;
            countedAt = System.nanoTime();
            return counts;
        } catch (ExecutionException | TimeoutException e) {
            throw new Problem(
                    503,
                    "kafka-away",
                    "Kafka does not return the offsets of its topics; check --kafka and that it runs");
        } catch (InterruptedException e) {
            throw Problem.stopping();
        }
    }

    /** Whether the newest record of each key is retained forever; also true if the configuration cannot be read. */
    public boolean isCompacted(String topic) {
        ConfigResource resource = new ConfigResource(ConfigResource.Type.TOPIC, topic);
        try {
            return admin.describeConfigs(List.of(resource))
                    .all()
                    .get(TIMEOUT_SECONDS, TimeUnit.SECONDS)
                    .get(resource)
                    .get(TopicConfig.CLEANUP_POLICY_CONFIG)
                    .value()
                    .contains(TopicConfig.CLEANUP_POLICY_COMPACT);
        } catch (ExecutionException | TimeoutException e) {
            LOG.debug("the configuration of {} cannot be read", topic, e);
            return true;
        } catch (InterruptedException e) {
            throw Problem.stopping();
        }
    }

    /** Fails if Kafka does not respond in time. */
    public void checkKafka(Duration timeout) throws ExecutionException, TimeoutException, InterruptedException {
        admin.describeCluster(new DescribeClusterOptions().timeoutMs((int) timeout.toMillis()))
                .nodes()
                .get(timeout.toMillis(), TimeUnit.MILLISECONDS);
        lastAnswer = System.nanoTime();
    }

    /** Whether Kafka did not answer {@link #checkKafka} lately; does not wait. */
    public boolean isKafkaUnavailable() {
        return System.nanoTime() - lastAnswer > UNAVAILABLE_AFTER.toNanos();
    }

    private static Problem unavailable() {
        return new Problem(503, "kafka-away", "Kafka does not return its topics; check --kafka and that it runs");
    }

    /** @throws Problem 404 if the topic does not exist or Kafka's ACLs hide it, 503 if Kafka does not respond */
    public void check(String topic) {
        if (!exists(topic)) {
            throw new Problem(404, "unknown-topic", "there is no topic '%s'".formatted(topic));
        }
    }

    /** Whether the topic exists and Kafka's ACLs do not hide it. @throws Problem 503 if Kafka does not respond */
    public boolean exists(String topic) {
        if (isKafkaUnavailable()) {
            throw unavailable();
        }
        try {
            // not the list of all topics: a farm has thousands after a year, and the page opens a dozen streams
            admin.describeTopics(List.of(topic)).allTopicNames().get(TIMEOUT_SECONDS, TimeUnit.SECONDS);
            lastAnswer = System.nanoTime();
            return true;
        } catch (ExecutionException e) {
            if (e.getCause() instanceof UnknownTopicOrPartitionException
                    || e.getCause() instanceof InvalidTopicException
                    || e.getCause() instanceof TopicAuthorizationException) {
                return false;
            }
            throw unavailable();
        } catch (TimeoutException e) {
            throw unavailable();
        } catch (InterruptedException e) {
            throw Problem.stopping();
        }
    }

    /** Adds a stream; returns once each record that is written from now on goes to it. */
    public void add(String topic, TopicFeed.Stream stream) throws InterruptedException {
        TopicFeed feed;
        synchronized (feeds) {
            if (closed) {
                throw new Problem(503, "stopping", "the dashboard is stopping");
            }
            feed = feeds.get(topic);
            if (feed == null || feed.hasFailed()) {
                feed = new TopicFeed(topic, client, limits, counters);
                feeds.put(topic, feed);
            }
            feed.add(stream);
        }
        feed.awaitStarted();
    }

    public void remove(String topic, TopicFeed.Stream stream) {
        TopicFeed unused = null;
        synchronized (feeds) {
            TopicFeed feed = feeds.get(topic);
            if (feed != null && feed.remove(stream)) {
                unused = feeds.remove(topic);
            }
        }
        if (unused != null) {
            unused.close();
        }
    }

    /** The number of topics that are read. */
    public int size() {
        synchronized (feeds) {
            return feeds.size();
        }
    }

    @Override
    public void close() {
        synchronized (feeds) {
            closed = true;
            feeds.values().forEach(TopicFeed::close);
            feeds.clear();
        }
        admin.close(Duration.ofSeconds(1));
    }
}
