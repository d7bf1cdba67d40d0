package io.furrow.soak.source;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.locks.LockSupport;

import org.apache.kafka.clients.admin.NewTopic;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.model.topic.Topics;
import io.furrow.soak.control.Http;
import io.furrow.soak.control.Until;
import io.furrow.soak.source.NotificationTap.Try;
import io.furrow.soak.source.SourceGroup.Member;
import io.furrow.soak.source.WorkerGauges.Shown;

/** Kafka, a context broker whose entities change, and the workers that receive its notifications. */
final class WorkersFarm implements AutoCloseable {
    static final int ENTITIES = 60;

    private static final Duration LOAD = Duration.ofSeconds(2);
    private static final Duration TIMEOUT = Duration.ofSeconds(120);
    private static final Duration REPAIR_TIMEOUT = Duration.ofSeconds(60);

    private final EmbeddedKafka kafka;
    private final FiwareStandIn contextBroker;
    final NotificationTap tap;
    final EntityChanges changes;
    final SourceGroup group;
    final ChangesOnTopic topic;

    private WorkersFarm(Path folder, int perSecond, boolean exactlyOnce) throws IOException {
        kafka = EmbeddedKafka.start(folder.resolve("kafka"));
        contextBroker = FiwareStandIn.start(FiwareSettings.httpOnly());
        tap = new NotificationTap();
        changes = EntityChanges.prepare(contextBroker.contextBroker(), ENTITIES, perSecond);
        group = new SourceGroup(folder, kafka.bootstrapServers(), exactlyOnce);
        createTopic();
        topic = new ChangesOnTopic(kafka.bootstrapServers());
    }

    /** Starts without workers. */
    static WorkersFarm start(Path folder, int perSecond, boolean exactlyOnce) throws IOException {
        return new WorkersFarm(folder, perSecond, exactlyOnce);
    }

    /** Creates the topic in advance: with automatic creation its partitions appear one by one. */
    private void createTopic() {
        kafka.createTopics(List.of(new NewTopic(Topics.RAW, EmbeddedKafka.PARTITIONS, (short) 1)));
    }

    /** Creates the source on the workers; returns once each of its tasks has its subscription. */
    void subscribe() {
        group.createSource(contextBroker.contextBroker(), tap.publicUrl());
        group.awaitTasks();
        URI subscriptions = URI.create(contextBroker.contextBroker() + "/v2/subscriptions");
        Until.isTrue(
                "each task has its subscription",
                TIMEOUT,
                () -> Http.get(subscriptions).body().size() == SourceGroup.TASKS);
    }

    /** Changes entities for a while, then prints the gauges; changes continue. @return the maximum of records left */
    long load(String when) {
        changes.resume();
        long[] left = {0};
        long end = System.nanoTime() + LOAD.toNanos();
        while (System.nanoTime() < end) {
            LockSupport.parkNanos(Duration.ofMillis(250).toNanos());
            group.shown().values().forEach(shown -> left[0] = Math.max(left[0], shown.leftRecords()));
        }
        System.out.println(when);
        group.shown().forEach((worker, shown) -> System.out.printf("  %s: %s%n", worker, shown));
        return left[0];
    }

    /** Pauses changes, and waits until no notification is pending. */
    void awaitAnswers() {
        changes.pause();
        Until.isTrue(
                "every notification is answered",
                TIMEOUT,
                () -> contextBroker.counters().notificationsQueued() == 0 && tap.isIdle());
    }

    /** Pauses changes, and waits until all records are in Kafka and repaired. */
    void awaitQuiet() {
        awaitAnswers();
        Until.isTrue("every journal is drained", TIMEOUT, () -> {
            var shown = group.shown().values();
            return shown.stream().mapToInt(Shown::tasks).sum() == SourceGroup.TASKS
                    && shown.stream()
                            .allMatch(each -> each.onDisk() == 0 && each.adopted() == 0 && each.orphaned() == 0);
        });
        List<NumberedChange> newest = changes.newest();
        Until.within(REPAIR_TIMEOUT, () -> {
            topic.read();
            return topic.notNewest(newest).isEmpty();
        });
    }

    /** Acknowledged changes without a record of a notification in Kafka. */
    List<NumberedChange> missing() {
        return tap.changes().stream()
                .filter(change -> topic.notified(change) == 0)
                .filter(change -> tap.tries(change).stream().anyMatch(Try::isAcknowledged))
                .toList();
    }

    /** Whether a listener of this worker acknowledged the change. */
    boolean isAt(Member member, NumberedChange change) {
        return tap.tries(change).stream().anyMatch(tried -> tried.isAcknowledged() && member.has(tried.port()));
    }

    @Override
    public void close() {
        changes.close();
        group.close();
        topic.close();
        tap.close();
        contextBroker.close();
        kafka.close();
    }
}
