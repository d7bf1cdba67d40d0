package io.furrow.dashboard;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.servlet.http.HttpServletRequest;
import jakarta.servlet.http.HttpServletResponse;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.GroupListing;
import org.apache.kafka.clients.admin.ListConsumerGroupOffsetsSpec;
import org.apache.kafka.clients.admin.OffsetSpec;
import org.apache.kafka.clients.admin.TopicDescription;
import org.apache.kafka.clients.consumer.OffsetAndMetadata;
import org.apache.kafka.common.TopicPartition;

import io.furrow.dashboard.auth.User;
import io.furrow.dashboard.auth.UserServlet;
import io.furrow.dashboard.http.Problem;
import io.furrow.dashboard.proxy.TopicStreams;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;

/**
 * {@code GET /api/platform}: the state of the platform. Returns the lag of each consumer group by its committed
 * offsets, the number of records in each topic of dead letters, and the state of the control plane's parts. The result
 * is cached for two seconds.
 */
final class PlatformServlet extends UserServlet {
    private static final long serialVersionUID = 1L;
    private static final Duration TIME_TO_LIVE = Duration.ofSeconds(2);
    private static final Duration TIMEOUT = Duration.ofSeconds(5);
    private static final String DEAD = ".dead";

    private final transient TopicStreams streams;
    private final transient Admin admin;
    private final transient URI readiness;
    private final transient HttpClient http =
            HttpClient.newBuilder().connectTimeout(TIMEOUT).build();
    private transient byte[] cached;
    private transient long cachedAt;

    /** @param controlPlane base URL of its REST API */
    PlatformServlet(TopicStreams streams, Admin admin, URI controlPlane) {
        super(streams.users(), streams.counters()::rejected);
        this.streams = streams;
        this.admin = admin;
        this.readiness = URI.create(controlPlane + "/ready");
    }

    @Override
    protected void answer(HttpServletRequest request, HttpServletResponse response, User user) throws IOException {
        write(current(), response);
    }

    private synchronized byte[] current() {
        if (cached == null || System.nanoTime() - cachedAt > TIME_TO_LIVE.toNanos()) {
            ObjectNode platform = NgsiJson.object();
            platform.put("time", System.currentTimeMillis());
            addKafka(platform);
            platform.set("controlPlane", controlPlane());
            cached = NgsiJson.write(platform);
            cachedAt = System.nanoTime();
        }
        return cached;
    }

    /**
     * Adds what Kafka reports. If it is unavailable, adds the reason instead, and the other parts are shown
     * nevertheless.
     */
    private void addKafka(ObjectNode platform) {
        ArrayNode deadLetters = platform.putArray("deadLetters");
        ArrayNode groups = platform.putArray("groups");
        ObjectNode kafka = platform.putObject("kafka");
        if (streams.feeds().isKafkaUnavailable()) { // no further timeout
            kafka.put("state", "away").put("reason", reason(new TimeoutException()));
            return;
        }
        try {
            Map<TopicPartition, Long> ends = ends();
            kafka.put("state", "up");
            kafka.put(
                    "topics",
                    ends.keySet().stream().map(TopicPartition::topic).distinct().count());
            addDeadLetters(deadLetters, ends);
            addGroups(groups, ends);
        } catch (ExecutionException | TimeoutException e) {
            Throwable cause = e instanceof ExecutionException ? e.getCause() : e;
            kafka.put("state", "away").put("reason", reason(cause));
        } catch (InterruptedException e) {
            throw Problem.stopping();
        }
    }

    private static String reason(Throwable cause) {
        return cause instanceof TimeoutException || cause instanceof org.apache.kafka.common.errors.TimeoutException
                ? "Kafka did not answer within %d s; check --kafka and that it runs".formatted(TIMEOUT.toSeconds())
                : "Kafka cannot report its state: " + FailureText.of(cause);
    }

    private Map<TopicPartition, Long> ends() throws InterruptedException, ExecutionException, TimeoutException {
        Set<String> names = admin.listTopics().names().get(TIMEOUT.toSeconds(), TimeUnit.SECONDS);
        Set<TopicPartition> partitions = new HashSet<>();
        for (TopicDescription topic : admin.describeTopics(names)
                .allTopicNames()
                .get(TIMEOUT.toSeconds(), TimeUnit.SECONDS)
                .values()) {
            topic.partitions().forEach(each -> partitions.add(new TopicPartition(topic.name(), each.partition())));
        }
        return offsets(partitions, OffsetSpec.latest());
    }

    private Map<TopicPartition, Long> offsets(Set<TopicPartition> partitions, OffsetSpec spec)
            throws InterruptedException, ExecutionException, TimeoutException {
        Map<TopicPartition, OffsetSpec> specs = new HashMap<>();
        partitions.forEach(each -> specs.put(each, spec));
        Map<TopicPartition, Long> offsets = new HashMap<>();
        admin.listOffsets(specs)
                .all()
                .get(TIMEOUT.toSeconds(), TimeUnit.SECONDS)
                .forEach((partition, found) -> offsets.put(partition, found.offset()));
        return offsets;
    }

    /** Counts the records that retention has not deleted. */
    private void addDeadLetters(ArrayNode to, Map<TopicPartition, Long> ends)
            throws InterruptedException, ExecutionException, TimeoutException {
        Set<TopicPartition> dead = new HashSet<>(ends.keySet());
        dead.removeIf(each -> !each.topic().endsWith(DEAD));
        Map<TopicPartition, Long> begins = offsets(dead, OffsetSpec.earliest());
        Map<String, Long> deadLetters = new TreeMap<>();
        dead.forEach(each -> deadLetters.merge(each.topic(), ends.get(each) - begins.get(each), Long::sum));
        deadLetters.forEach((topic, count) -> to.addObject().put("topic", topic).put("records", count));
    }

    private void addGroups(ArrayNode to, Map<TopicPartition, Long> ends)
            throws InterruptedException, ExecutionException, TimeoutException {
        List<String> groups = new ArrayList<>();
        for (GroupListing group : admin.listGroups().all().get(TIMEOUT.toSeconds(), TimeUnit.SECONDS)) {
            groups.add(group.groupId());
        }
        groups.sort(null);
        Map<String, ListConsumerGroupOffsetsSpec> specs = new HashMap<>();
        groups.forEach(group -> specs.put(group, new ListConsumerGroupOffsetsSpec()));
        Map<String, Map<TopicPartition, OffsetAndMetadata>> committed = specs.isEmpty()
                ? Map.of()
                : admin.listConsumerGroupOffsets(specs).all().get(TIMEOUT.toSeconds(), TimeUnit.SECONDS);
        for (String group : groups) {
            Map<String, Long> lags = new TreeMap<>();
            committed.getOrDefault(group, Map.of()).forEach((partition, offset) -> {
                Long end = ends.get(partition);
                if (offset != null && end != null) {
                    lags.merge(partition.topic(), Math.max(0, end - offset.offset()), Long::sum);
                }
            });
            if (!lags.isEmpty()) {
                ObjectNode entry = to.addObject().put("group", group);
                entry.put(
                        "lag", lags.values().stream().mapToLong(Long::longValue).sum());
                ObjectNode topics = entry.putObject("topics");
                lags.forEach(topics::put);
            }
        }
    }

    /** The control plane's readiness, or why it cannot be read. */
    private JsonNode controlPlane() {
        try {
            HttpResponse<byte[]> ready = http.send(
                    HttpRequest.newBuilder(readiness).timeout(TIMEOUT).build(),
                    HttpResponse.BodyHandlers.ofByteArray());
            return NgsiJson.read(ready.body());
        } catch (IOException | UnreadableException e) {
            return NgsiJson.object()
                    .put("status", "away")
                    .put("reason", "%s does not answer (%s)".formatted(readiness, FailureText.of(e)));
        } catch (InterruptedException e) {
            throw Problem.stopping();
        }
    }
}
