package io.furrow.control;

import java.io.IOException;
import java.util.ArrayList;
import java.util.Collection;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.stream.Stream;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.AlterConfigOp;
import org.apache.kafka.clients.admin.ConfigEntry;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.KafkaFuture;
import org.apache.kafka.common.config.ConfigResource;
import org.apache.kafka.common.errors.TopicExistsException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.HangingTransactions;
import io.furrow.model.control.Limits;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.Topics;

/**
 * Creates the topics that the control plane reads and writes. Topics of requests have the broker's retention and
 * timestamps; topics of desired and actual state are compacted. All have one partition, so that records stay in order.
 * Missing topics of data are created with the broker's number of partitions.
 */
public final class ServiceTopics {
    private static final Logger LOG = LoggerFactory.getLogger(ServiceTopics.class);
    private static final long TIMEOUT_SECONDS = 30;
    private static final long POLL_INTERVAL_MILLIS = 50;
    private static final int STATUS_SEGMENT_BYTES = 16 * 1024 * 1024;
    private static final int STATUS_SEGMENT_MINUTES = 10;
    /** Written again and again while devices report, missions are recorded, replays play or a fault lasts. */
    private static final Set<String> REPEATED = Set.of(
            Topics.DEVICES_HEALTH, Topics.DEVICES_CONNECTION, Topics.FAULTS, Topics.RECORDINGS, Topics.REPLAYS_STATUS);

    private static final String POLICY = "cleanup.policy";
    private static final String MAX_BYTES = "max.message.bytes";

    private static final List<String> REQUESTS =
            List.of(Topics.DOMAIN_MANAGER, Topics.MISSION_MANAGER, Topics.REPLAY_MANAGER, Topics.ALARM_MANAGER);
    private static final List<String> COMPACTED = List.of(
            Topics.DOMAINS,
            Topics.MISSIONS,
            Topics.TEMPLATES,
            Topics.DEVICES,
            Topics.MISSION_DEVICES,
            Topics.REPLAYS,
            Topics.RECORDINGS,
            Topics.MISSIONS_STATUS,
            Topics.DEVICES_STATUS,
            Topics.DEVICES_HEALTH,
            Topics.DEVICES_CONNECTION,
            Topics.FAULTS,
            Topics.REPLAYS_STATUS,
            Topics.ALARMS,
            Topics.ALARMS_DELIVERED,
            Topics.SECRETS);
    /** A year; an existing topic is not altered, so that users can change its retention. */
    private static final Map<String, String> LONG_RETENTION =
            Map.of(POLICY, "delete", "retention.ms", Long.toString(TimeUnit.DAYS.toMillis(365)));
    /** Topics shared with jobs: created like the jobs do, never altered. */
    private static final List<String> DATA =
            List.of(Topics.RAW, Topics.COLLISION, Topics.TEMPERATURE, Topics.CLOCKS, Topics.CONTEXT);

    /** Dead letters of the topics that the control plane reads. */
    private static final List<String> DEAD_LETTERS = Stream.of(
                    REQUESTS,
                    DATA,
                    List.of(
                            Topics.DOMAINS,
                            Topics.MISSIONS,
                            Topics.MISSIONS_STATUS,
                            Topics.DEVICES_STATUS,
                            Topics.DEVICES_HEALTH,
                            Topics.FAULTS,
                            Topics.REPLAYS_STATUS))
            .flatMap(List::stream)
            .map(Topics::dead)
            .toList();

    private ServiceTopics() {}

    /**
     * Creates the missing topics. On existing ones, which a client may have created implicitly, it sets cleanup policy
     * and limits: else the broker would delete desired state, or accept records that are too large to be handled.
     *
     * @throws IOException if Kafka does not respond or denies access
     */
    public static void prepare(ControlSettings settings) throws IOException {
        try (Admin admin = Admin.create(settings.client())) {
            abortHangingTransactions(admin);
            List<NewTopic> desired = desired(settings);
            for (KafkaFuture<Void> made : admin.createTopics(desired).values().values()) {
                await(made, true);
            }
            Map<ConfigResource, Collection<AlterConfigOp>> policies = new LinkedHashMap<>();
            REQUESTS.forEach(name -> set(policies, name, requestConfigs()));
            COMPACTED.forEach(name -> set(policies, name, stateConfigs(name)));
            await(admin.incrementalAlterConfigs(policies).all(), false);
            awaitMetadata(admin, desired.stream().map(NewTopic::name).toList());
        } catch (KafkaException | ExecutionException | TimeoutException e) {
            throw new IOException(
                    "The topics service.* cannot be prepared at %s (%s). Check the address, and that the user may create and alter them."
                            .formatted(settings.client().get("bootstrap.servers"), FailureText.of(e)),
                    e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new IOException("interrupted while the topics service.* were prepared", e);
        }
    }

    /** Else a transaction that a power cut left open would stop the restore of states. Replicas have none. */
    private static void abortHangingTransactions(Admin admin)
            throws InterruptedException, ExecutionException, TimeoutException {
        if (admin.describeCluster()
                        .nodes()
                        .get(TIMEOUT_SECONDS, TimeUnit.SECONDS)
                        .size()
                > 1) {
            return;
        }
        try {
            HangingTransactions.abort(admin);
        } catch (ExecutionException e) {
            LOG.warn(
                    "Kafka does not tell whether a power cut left transactions open ({}); if states are not restored, use kafka-transactions.sh find-hanging",
                    FailureText.of(e));
        }
    }

    static List<NewTopic> desired(ControlSettings settings) {
        List<NewTopic> desired = new ArrayList<>();
        REQUESTS.forEach(name -> desired.add(topic(name, settings, requestConfigs())));
        COMPACTED.forEach(name -> desired.add(topic(name, settings, stateConfigs(name))));
        desired.add(topic(Topics.AUDIT, settings, LONG_RETENTION));
        desired.add(topic(
                Topics.FIELDS, settings, Map.of(POLICY, "compact"))); // created like an import does, never altered
        Stream.concat(DATA.stream(), DEAD_LETTERS.stream())
                .forEach(name -> desired.add(
                        topic(name, settings, Map.of(MAX_BYTES, Integer.toString(Limits.DEAD_LETTER_BYTES)))));
        return desired;
    }

    /** Waits until the broker lists the topics, because its metadata lags behind their creation. */
    private static void awaitMetadata(Admin admin, List<String> names)
            throws ExecutionException, InterruptedException, TimeoutException {
        long end = System.nanoTime() + TimeUnit.SECONDS.toNanos(TIMEOUT_SECONDS);
        while (!admin.listTopics()
                .names()
                .get(TIMEOUT_SECONDS, TimeUnit.SECONDS)
                .containsAll(names)) {
            if (System.nanoTime() > end) {
                throw new TimeoutException("the broker does not list all topics that were created");
            }
            TimeUnit.MILLISECONDS.sleep(POLL_INTERVAL_MILLIS);
        }
    }

    private static NewTopic topic(String name, ControlSettings settings, Map<String, String> configs) {
        Optional<Short> replication =
                settings.replicationFactor() < 0 ? Optional.empty() : Optional.of(settings.replicationFactor());
        Optional<Integer> partitions = DATA.contains(name) ? Optional.empty() : Optional.of(1);
        return new NewTopic(name, partitions, replication).configs(configs);
    }

    /**
     * Timestamps are those of the broker, because the control plane uses them to tell old requests from new ones.
     * Records are uncompressed, so that the broker's limit applies to the size that a manager will see: a compressed
     * megabyte may contain a gigabyte.
     */
    private static Map<String, String> requestConfigs() {
        return Map.of(
                POLICY,
                "delete",
                "message.timestamp.type",
                "LogAppendTime",
                "compression.type",
                "uncompressed",
                MAX_BYTES,
                Integer.toString(Limits.MESSAGE_BYTES));
    }

    /** Segments of repeated states are small: the active segment is not compacted, and a start reads all of it, by default a week. */
    private static Map<String, String> stateConfigs(String topic) {
        Map<String, String> configs = new LinkedHashMap<>();
        configs.put(POLICY, "compact");
        configs.put("compression.type", "uncompressed");
        configs.put(MAX_BYTES, Integer.toString(Limits.MESSAGE_BYTES));
        if (REPEATED.contains(topic)) {
            configs.put("segment.bytes", Integer.toString(STATUS_SEGMENT_BYTES));
            configs.put("segment.ms", Long.toString(TimeUnit.MINUTES.toMillis(STATUS_SEGMENT_MINUTES)));
        }
        return configs;
    }

    private static void set(
            Map<ConfigResource, Collection<AlterConfigOp>> all, String topic, Map<String, String> configs) {
        List<AlterConfigOp> changes = configs.entrySet().stream()
                .map(each ->
                        new AlterConfigOp(new ConfigEntry(each.getKey(), each.getValue()), AlterConfigOp.OpType.SET))
                .toList();
        all.put(new ConfigResource(ConfigResource.Type.TOPIC, topic), changes);
    }

    private static void await(KafkaFuture<Void> done, boolean mayExist)
            throws ExecutionException, InterruptedException, TimeoutException {
        try {
            done.get(TIMEOUT_SECONDS, TimeUnit.SECONDS);
        } catch (ExecutionException e) {
            if (!mayExist || !(e.getCause() instanceof TopicExistsException)) {
                throw e;
            }
        }
    }
}
