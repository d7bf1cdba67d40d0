package io.furrow.control.replay;

import java.io.IOException;
import java.time.Clock;
import java.util.List;
import java.util.Optional;
import java.util.Properties;

import org.apache.kafka.clients.producer.Producer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.CommittedReader;
import io.furrow.kafka.ComponentStatus;
import io.furrow.kafka.KafkaClients;
import io.furrow.kafka.SupervisedWorker;
import io.furrow.mission.mongo.MissionCatalog;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.model.control.RecordedMission;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.Topics;

/**
 * Publishes the missions recorded in MongoDB on {@code service.recordings}. Several instances may run: each writes only
 * differences to the topic. While MongoDB is unavailable, the last list stays.
 */
public final class RecordingWatch implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(RecordingWatch.class);

    private final Properties client;
    private final ReplaySettings settings;
    private final Clock clock;
    private final SupervisedWorker worker;
    private volatile int size;

    private RecordingWatch(Properties client, ReplaySettings settings, Clock clock) {
        this.client = client;
        this.settings = settings;
        this.clock = clock;
        this.worker = new SupervisedWorker("recording-watch", clock);
    }

    /**
     * Starts without waiting for MongoDB. The topic must exist already.
     *
     * @param settings with a MongoDB
     * @throws IOException if its URI is invalid
     */
    public static RecordingWatch start(Properties client, ReplaySettings settings, Clock clock) throws IOException {
        try {
            MissionCatalog.open(settings.mongo(), settings.database()).close();
        } catch (IllegalArgumentException e) {
            throw new IOException(
                    "--mongo is not a connection string of MongoDB (%s). Name one such as mongodb://127.0.0.1:27017."
                            .formatted(MongoAccess.fault(settings.mongo(), e)),
                    e);
        }
        RecordingWatch watch = new RecordingWatch(client, settings, clock);
        watch.worker.start(watch::run, () -> watch.size + " missions are stored");
        return watch;
    }

    private void run(SupervisedWorker running) throws InterruptedException {
        RecordingList list = new RecordingList();
        try (MissionCatalog catalog = MissionCatalog.open(settings.mongo(), settings.database());
                CommittedReader<String> topic = CommittedReader.open(client, Topics.RECORDINGS);
                Producer<String, byte[]> producer = KafkaClients.producer(client)) {
            boolean unavailable = false;
            while (!running.isClosing()) {
                // read before the names are queried, so that these are newer
                topic.readToEnd(record -> list.take(record.key(), record.value(), record.timestamp()));
                size = list.size();
                try {
                    write(list, new Catalogued(catalog), producer);
                    unavailable = false;
                    running.succeeded();
                } catch (IOException e) {
                    if (!unavailable) {
                        LOG.warn("{} does not change until MongoDB is back", Topics.RECORDINGS, e);
                    }
                    unavailable = true;
                    running.failed(FailureText.of(e));
                }
                running.pause(settings.pollInterval());
            }
        }
    }

    private void write(RecordingList list, RecordingList.Store store, Producer<String, byte[]> producer)
            throws IOException {
        list.changes(store, clock.millis())
                .forEach((mission, found) -> producer.send(new ProducerRecord<>(
                        Topics.RECORDINGS,
                        mission,
                        found.map(RecordedMission::toBytes).orElse(null))));
        producer.flush();
    }

    /** Identifies missions by the names used in commands and topics: those of collections. */
    private record Catalogued(MissionCatalog catalog) implements RecordingList.Store {
        @Override
        public List<String> names() throws IOException {
            return catalog.topicNames();
        }

        @Override
        public Optional<RecordedMission> find(String name) throws IOException {
            long events = catalog.events(name).orElse(0);
            return catalog.find(name)
                    .flatMap(stored -> stored.span())
                    .map(span -> new RecordedMission(name, span.first(), span.last(), events));
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
