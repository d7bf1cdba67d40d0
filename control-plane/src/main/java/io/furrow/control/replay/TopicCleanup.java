package io.furrow.control.replay;

import java.time.Clock;
import java.time.Duration;
import java.util.List;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.ExecutionException;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.Producer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.KafkaFuture;
import org.apache.kafka.common.errors.UnknownTopicOrPartitionException;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.CommittedReader;
import io.furrow.kafka.PartStatus;
import io.furrow.kafka.RestartingWorker;
import io.furrow.model.topic.Topics;

/**
 * Deletes the topic of a replay, and those of what was found in it, a grace period after the replay was over, then its status. Several
 * instances may do so.
 */
public final class ReplayCleanup implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(ReplayCleanup.class);
    private static final Duration MAX_INTERVAL = Duration.ofSeconds(10);
    private static final Duration MIN_INTERVAL = Duration.ofMillis(100);

    private final Properties client;
    private final Duration grace;
    private final Clock clock;
    private final RestartingWorker worker;
    private volatile long deleted;

    private ReplayCleanup(Properties client, Duration grace, Clock clock) {
        this.client = client;
        this.grace = grace;
        this.clock = clock;
        this.worker = new RestartingWorker("replay-cleanup", clock);
    }

    /** The topics of the control plane are there already. */
    public static ReplayCleanup start(Properties client, ReplaySettings settings, Clock clock) {
        ReplayCleanup cleanup = new ReplayCleanup(client, settings.grace(), clock);
        cleanup.worker.start(cleanup::run, () -> cleanup.deleted + " topics of replays deleted");
        return cleanup;
    }

    private void run(RestartingWorker running) throws InterruptedException {
        FinishedReplays remains = new FinishedReplays();
        try (Admin admin = Admin.create(client);
                CommittedReader<String> topics = CommittedReader.open(client, Topics.REPLAYS, Topics.REPLAYS_STATUS);
                Producer<String, byte[]> producer =
                        new KafkaProducer<>(client, new StringSerializer(), new ByteArraySerializer())) {
            while (!running.isClosing()) {
                topics.readToEnd(remains::take);
                for (FinishedReplays.Remains due : remains.overBy(clock.millis() - grace.toMillis())) {
                    topics.readToEnd(remains::take); // it may be wanted again since
                    if (remains.overBy(clock.millis() - grace.toMillis()).contains(due)) {
                        remove(due, admin, producer);
                    }
                }
                running.succeeded();
                running.pause(interval());
            }
        } catch (ExecutionException e) {
            throw new KafkaException("topics of a replay cannot be deleted", e.getCause());
        }
    }

    /** A tenth of the grace period, within limits. */
    private Duration interval() {
        Duration tenth = grace.dividedBy(10);
        Duration least = tenth.compareTo(MIN_INTERVAL) < 0 ? MIN_INTERVAL : tenth;
        return least.compareTo(MAX_INTERVAL) > 0 ? MAX_INTERVAL : least;
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
            for (KafkaFuture<Void> each :
                    admin.deleteTopics(all).topicNameValues().values()) {
                await(each);
            }
            deleted += all.size();
            LOG.info("replay {} was over for {}; deleted {}", remains.replay(), grace, all);
        }
        producer.send(new ProducerRecord<>(Topics.REPLAYS_STATUS, remains.replay(), null));
        producer.flush();
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
    public PartStatus status() {
        return worker.status();
    }

    @Override
    public void close() {
        worker.close();
    }
}
