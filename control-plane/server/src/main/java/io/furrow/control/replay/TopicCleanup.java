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
 * Deletes the topic of a replay, and those of what was found in it, a grace period after the replay was over, then its status; and the
 * topic of a mission or domain, with its dead letters, a day after it was deleted, where nothing of the last day is in them, nothing was
 * written lately and no replay reads it. A topic that cannot be deleted is tried again later and keeps no other. Several instances may do so.
 */
public final class TopicCleanup implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(TopicCleanup.class);
    private static final Duration MAX_INTERVAL = Duration.ofSeconds(10);
    private static final Duration MIN_INTERVAL = Duration.ofMillis(100);
    /** Consumers may have a night, and devices that were away what they kept. */
    private static final Duration GRACE_OF_MISSIONS = Duration.ofDays(1);
    /** A job asks after minutes of quiet whether a topic is there still, before it writes what a device had kept for long. */
    private static final long QUIET_MILLIS = Duration.ofMinutes(15).toMillis();
    /** One that a broker does not answer for takes a minute. */
    private static final Duration RETRY = Duration.ofMinutes(10);

    private final Properties client;
    private final Duration grace;
    private final Clock clock;
    private final SupervisedWorker worker;
    /** What the topics that are due held when that last changed. */
    private final Map<String, Content> contents = new HashMap<>();
    /** When those that could not be deleted are tried again, epoch ms. */
    private final Map<String, Long> retries = new HashMap<>();

    private volatile long deleted;

    private TopicCleanup(Properties client, Duration grace, Clock clock) {
        this.client = client;
        this.grace = grace;
        this.clock = clock;
        this.worker = new SupervisedWorker("topic-cleanup", clock);
    }

    /** The topics of the control plane are there already. */
    public static TopicCleanup start(Properties client, ReplaySettings settings, Clock clock) {
        TopicCleanup cleanup = new TopicCleanup(client, settings.grace(), clock);
        cleanup.worker.start(cleanup::run, () -> cleanup.deleted + " topics of replays, missions and domains deleted");
        return cleanup;
    }

    private void run(SupervisedWorker running) throws InterruptedException {
        FinishedReplays remains = new FinishedReplays();
        DeletedNames names = new DeletedNames();
        RecordAction<String, RuntimeException> taking = record -> {
            if (record.topic().equals(Topics.MISSIONS) || record.topic().equals(Topics.DOMAINS)) {
                names.take(record);
            } else {
                remains.take(record);
            }
        };
        try (Admin admin = Admin.create(client);
                CommittedReader<String> topics = CommittedReader.open(
                        client, Topics.REPLAYS, Topics.REPLAYS_STATUS, Topics.MISSIONS, Topics.DOMAINS);
                Producer<String, byte[]> producer = KafkaClients.producer(client)) {
            while (!running.isClosing()) {
                topics.readToEnd(taking);
                for (FinishedReplays.Remains due : remains.overBy(clock.millis() - grace.toMillis())) {
                    attempt(due.topic(), () -> {
                        topics.readToEnd(taking); // it may be wanted again since
                        if (remains.overBy(clock.millis() - grace.toMillis()).contains(due)) {
                            remove(due, admin, producer);
                        }
                    });
                }
                removeMissions(names, remains, admin, () -> topics.readToEnd(taking));
                retries.keySet().retainAll(due(names, remains));
                if (retries.isEmpty()) {
                    running.succeeded();
                }
                running.pause(interval());
            }
        } catch (ExecutionException e) {
            throw new KafkaException("Kafka does not say which topics there are", e.getCause());
        }
    }

    private Set<String> due(DeletedNames names, FinishedReplays remains) {
        return Stream.concat(
                        names.by(clock.millis() - GRACE_OF_MISSIONS.toMillis()).stream(),
                        remains.overBy(clock.millis() - grace.toMillis()).stream()
                                .map(FinishedReplays.Remains::topic))
                .collect(toSet());
    }

    /** A deletion. */
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

    /** The status last, so that what was not deleted is tried again. */
    private void remove(FinishedReplays.Remains remains, Admin admin, Producer<String, byte[]> producer)
            throws ExecutionException, InterruptedException {
        if (Topics.isReplay(remains.topic())) {
            Set<String> names = admin.listTopics().names().get();
            List<String> all = names.stream()
                    .filter(name -> name.equals(remains.topic()) || name.startsWith(remains.topic() + "."))
                    .sorted()
                    .toList();
            delete(all, admin);
            LOG.info("replay {} was over for {}; deleted {}", remains.replay(), grace, all);
        }
        producer.send(new ProducerRecord<>(Topics.REPLAYS_STATUS, remains.replay(), null));
        producer.flush();
    }

    /** @param refresh reads what was asked for since */
    private void removeMissions(DeletedNames names, FinishedReplays replays, Admin admin, Runnable refresh)
            throws ExecutionException, InterruptedException {
        long moment = clock.millis() - GRACE_OF_MISSIONS.toMillis();
        List<String> due = names.by(moment);
        Set<String> there =
                due.isEmpty() ? Set.of() : admin.listTopics().names().get();
        for (String topic : due) {
            attempt(topic, () -> {
                boolean quiet = true;
                for (String each : withDeadLetters(topic, there)) {
                    quiet &= isQuiet(each, moment, admin); // of each, so that their times run together
                }
                if (!quiet) {
                    return;
                }
                refresh.run();
                if (!replays.isUsed(topic) && names.by(moment).contains(topic)) { // else it is wanted again
                    removeMission(topic, there, admin);
                    names.forget(topic);
                    contents.remove(topic);
                    contents.remove(Topics.dead(topic));
                }
            });
        }
    }

    private static List<String> withDeadLetters(String topic, Set<String> there) {
        return Stream.of(topic, Topics.dead(topic)).filter(there::contains).toList();
    }

    private void removeMission(String topic, Set<String> there, Admin admin)
            throws ExecutionException, InterruptedException {
        List<String> all = withDeadLetters(topic, there);
        if (!all.isEmpty()) {
            delete(all, admin);
            LOG.info("the owner of {} was deleted more than {} ago; deleted {}", topic, GRACE_OF_MISSIONS, all);
        }
    }

    /**
     * A topic at a moment.
     *
     * @param records ever written
     * @param newest event time, epoch ms; negative if it is empty
     * @param since when it was seen so first, epoch ms
     */
    private record Content(long records, long newest, long since) {}

    private boolean isQuiet(String topic, long moment, Admin admin) throws ExecutionException, InterruptedException {
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
        return now.newest() <= moment && clock.millis() - now.since() >= QUIET_MILLIS;
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
            if (!(e.getCause() instanceof UnknownTopicOrPartitionException)) { // another instance was faster
                throw e;
            }
        }
    }

    /** For a health page. */
    public ComponentStatus status() {
        return worker.status();
    }

    @Override
    public void close() {
        worker.close();
    }
}
