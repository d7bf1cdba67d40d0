package io.furrow.control.replay;

import java.time.Clock;
import java.time.Duration;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.ExecutionException;
import java.util.stream.Stream;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.ListOffsetsResult.ListOffsetsResultInfo;
import org.apache.kafka.clients.admin.OffsetSpec;
import org.apache.kafka.clients.producer.Producer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.KafkaFuture;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.UnknownTopicOrPartitionException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.CommittedReader;
import io.furrow.kafka.CommittedReader.RecordAction;
import io.furrow.kafka.ComponentStatus;
import io.furrow.kafka.KafkaClients;
import io.furrow.kafka.SupervisedWorker;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.Topics;

import static java.util.stream.Collectors.toMap;
import static java.util.stream.Collectors.toSet;

/**
 * Deletes obsolete topics. The topic of a replay and those of its results are deleted a grace period after the replay
 * was over, and its status after them. The topic of a mission or domain and its dead letters are deleted a day after
 * the mission or domain, unless they contain events of the last day, were written to recently, or are read by a replay.
 * A failed deletion is retried later and does not block others. Several instances may run.
 */
public final class TopicCleanup implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(TopicCleanup.class);
    private static final Duration MAX_INTERVAL = Duration.ofSeconds(10);
    private static final Duration MIN_INTERVAL = Duration.ofMillis(100);
    /** Time for consumers to catch up over night, and for offline devices to send their buffered reports. */
    private static final Duration GRACE_OF_MISSIONS = Duration.ofDays(1);
    /**
     * Minimum time without writes: a job checks after some minutes of quiet whether a topic still exists before it
     * writes a late report.
     */
    private static final long QUIET_MILLIS = Duration.ofMinutes(15).toMillis();
    /** Retry interval; a deletion without a response of the broker blocks for a minute. */
    private static final Duration RETRY = Duration.ofMinutes(10);

    private final Properties client;
    private final Duration grace;
    private final Clock clock;
    private final SupervisedWorker worker;
    /** Content of the due topics at its last change. */
    private final Map<String, Content> contents = new HashMap<>();
    /** Time of the next attempt by topic, epoch ms. */
    private final Map<String, Long> retries = new HashMap<>();

    private volatile long deleted;

    private TopicCleanup(Properties client, Duration grace, Clock clock) {
        this.client = client;
        this.grace = grace;
        this.clock = clock;
        this.worker = new SupervisedWorker("topic-cleanup", clock);
    }

    /** Starts the cleanup; the topics of the control plane must exist already. */
    public static TopicCleanup start(Properties client, ReplaySettings settings, Clock clock) {
        TopicCleanup cleanup = new TopicCleanup(client, settings.grace(), clock);
        cleanup.worker.start(cleanup::run, () -> cleanup.deleted + " topics of replays, missions and domains deleted");
        return cleanup;
    }

    private void run(SupervisedWorker running) throws InterruptedException {
        FinishedReplays finished = new FinishedReplays();
        DeletedNames names = new DeletedNames();
        RecordAction<String, RuntimeException> updating = record -> {
            if (record.topic().equals(Topics.MISSIONS) || record.topic().equals(Topics.DOMAINS)) {
                names.take(record);
            } else {
                finished.take(record);
            }
        };
        try (Admin admin = Admin.create(client);
                CommittedReader<String> topics = CommittedReader.open(
                        client, Topics.REPLAYS, Topics.REPLAYS_STATUS, Topics.MISSIONS, Topics.DOMAINS);
                Producer<String, byte[]> producer = KafkaClients.producer(client)) {
            while (!running.isClosing()) {
                topics.readToEnd(updating);
                for (FinishedReplays.Replay due : finished.finishedBy(clock.millis() - grace.toMillis())) {
                    attempt(due.topic(), () -> {
                        topics.readToEnd(updating); // it may have been requested again
                        if (finished.finishedBy(clock.millis() - grace.toMillis())
                                .contains(due)) {
                            remove(due, admin, producer);
                        }
                    });
                }
                removeMissions(names, finished, admin, () -> topics.readToEnd(updating));
                retries.keySet().retainAll(due(names, finished));
                if (retries.isEmpty()) {
                    running.succeeded();
                }
                running.pause(interval());
            }
        } catch (ExecutionException e) {
            throw new KafkaException("Kafka does not say which topics there are", e.getCause());
        }
    }

    private Set<String> due(DeletedNames names, FinishedReplays finished) {
        return Stream.concat(
                        names.deletedBy(clock.millis() - GRACE_OF_MISSIONS.toMillis()).stream(),
                        finished.finishedBy(clock.millis() - grace.toMillis()).stream()
                                .map(FinishedReplays.Replay::topic))
                .collect(toSet());
    }

    private interface Removal {
        void run() throws ExecutionException, InterruptedException;
    }

    private void attempt(String topic, Removal removal) throws InterruptedException {
        if (worker.isClosing() || clock.millis() < retries.getOrDefault(topic, Long.MIN_VALUE)) {
            return;
        }
        try {
            removal.run();
            retries.remove(topic);
        } catch (ExecutionException e) {
            retries.put(topic, clock.millis() + RETRY.toMillis());
            worker.failed("topic %s cannot be deleted (%s)".formatted(topic, FailureText.of(e.getCause())));
            LOG.warn(
                    "topic {} cannot be deleted; next attempt in {} min. Does its broker respond, and may this user delete it?",
                    topic,
                    RETRY.toMinutes(),
                    e.getCause());
        }
    }

    /** A tenth of the grace period, within limits. */
    private Duration interval() {
        Duration tenth = grace.dividedBy(10);
        Duration minimum = tenth.compareTo(MIN_INTERVAL) < 0 ? MIN_INTERVAL : tenth;
        return minimum.compareTo(MAX_INTERVAL) > 0 ? MAX_INTERVAL : minimum;
    }

    /** Deletes the status last, so that failed deletions are retried. */
    private void remove(FinishedReplays.Replay finished, Admin admin, Producer<String, byte[]> producer)
            throws ExecutionException, InterruptedException {
        if (Topics.isReplay(finished.topic())) {
            Set<String> names = admin.listTopics().names().get();
            List<String> all = names.stream()
                    .filter(name -> name.equals(finished.topic()) || name.startsWith(finished.topic() + "."))
                    .sorted()
                    .toList();
            delete(all, admin);
            LOG.info("replay {} was over for {}; deleted {}", finished.replay(), grace, all);
        }
        producer.send(new ProducerRecord<>(Topics.REPLAYS_STATUS, finished.replay(), null));
        producer.flush();
    }

    /** @param refresh reads newer requests */
    private void removeMissions(DeletedNames names, FinishedReplays replays, Admin admin, Runnable refresh)
            throws ExecutionException, InterruptedException {
        long time = clock.millis() - GRACE_OF_MISSIONS.toMillis();
        List<String> due = names.deletedBy(time);
        Set<String> existing =
                due.isEmpty() ? Set.of() : admin.listTopics().names().get();
        for (String topic : due) {
            attempt(topic, () -> {
                boolean quiet = true;
                for (String each : withDeadLetters(topic, existing)) {
                    quiet &= isQuiet(each, time, admin); // called for each, so that their quiet times run in parallel
                }
                if (!quiet) {
                    return;
                }
                refresh.run();
                if (!replays.isUsed(topic) && names.deletedBy(time).contains(topic)) { // else it is desired again
                    removeMission(topic, existing, admin);
                    names.forget(topic);
                    contents.remove(topic);
                    contents.remove(Topics.dead(topic));
                }
            });
        }
    }

    private static List<String> withDeadLetters(String topic, Set<String> existing) {
        return Stream.of(topic, Topics.dead(topic)).filter(existing::contains).toList();
    }

    private void removeMission(String topic, Set<String> existing, Admin admin)
            throws ExecutionException, InterruptedException {
        List<String> all = withDeadLetters(topic, existing);
        if (!all.isEmpty()) {
            delete(all, admin);
            LOG.info("the owner of {} was deleted more than {} ago; deleted {}", topic, GRACE_OF_MISSIONS, all);
        }
    }

    /**
     * The content of a topic.
     *
     * @param records number of records ever written
     * @param newest event time, epoch ms; negative if it is empty
     * @param since when this content was first observed, epoch ms
     */
    private record Content(long records, long newest, long since) {}

    private boolean isQuiet(String topic, long time, Admin admin) throws ExecutionException, InterruptedException {
        List<TopicPartition> partitions =
                admin.describeTopics(List.of(topic)).allTopicNames().get().get(topic).partitions().stream()
                        .map(each -> new TopicPartition(topic, each.partition()))
                        .toList();
        long records = offsets(partitions, OffsetSpec.latest(), admin)
                .mapToLong(ListOffsetsResultInfo::offset)
                .sum();
        long newest = offsets(partitions, OffsetSpec.maxTimestamp(), admin)
                .mapToLong(ListOffsetsResultInfo::timestamp)
                .max()
                .orElse(-1);
        Content now = contents.compute(
                topic,
                (same, before) -> before != null && before.records() == records
                        ? before
                        : new Content(records, newest, clock.millis()));
        return now.newest() <= time && clock.millis() - now.since() >= QUIET_MILLIS;
    }

    private static Stream<ListOffsetsResultInfo> offsets(List<TopicPartition> partitions, OffsetSpec which, Admin admin)
            throws ExecutionException, InterruptedException {
        return admin
                .listOffsets(partitions.stream().collect(toMap(each -> each, each -> which)))
                .all()
                .get()
                .values()
                .stream();
    }

    private void delete(List<String> topics, Admin admin) throws ExecutionException, InterruptedException {
        for (KafkaFuture<Void> each :
                admin.deleteTopics(topics).topicNameValues().values()) {
            await(each);
        }
        deleted += topics.size();
    }

    private static void await(KafkaFuture<Void> deletion) throws ExecutionException, InterruptedException {
        try {
            deletion.get();
        } catch (ExecutionException e) {
            if (!(e.getCause() instanceof UnknownTopicOrPartitionException)) { // else another instance deleted it
                throw e;
            }
        }
    }

    public ComponentStatus status() {
        return worker.status();
    }

    @Override
    public void close() {
        worker.close();
    }
}
