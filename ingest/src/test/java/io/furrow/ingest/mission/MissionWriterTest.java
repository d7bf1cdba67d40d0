package io.furrow.ingest.mission;

import java.nio.file.Path;
import java.time.Clock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import com.mongodb.client.MongoClient;
import com.mongodb.client.model.IndexOptions;
import com.mongodb.client.model.Indexes;
import org.apache.flink.api.connector.sink2.SinkWriter;
import org.apache.flink.metrics.groups.UnregisteredMetricsGroup;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedMongo;
import io.furrow.flink.record.TopicRecord;
import io.furrow.mission.bulk.BulkSender;
import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.Retention;
import io.furrow.model.event.DeadLetter;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

class MissionWriterTest {
    private final CollectedDeadLetters dead = new CollectedDeadLetters();

    private EmbeddedMongo mongo;
    private MongoClient client;
    private MissionCollections collections;
    private MissionWriter writer;

    @BeforeEach
    void start(@TempDir Path directory) {
        mongo = EmbeddedMongo.start(directory);
        client = new MongoAccess(mongo.uri() + "/?serverSelectionTimeoutMS=2000", MongoAccess.Waits.of(Duration.ZERO))
                .open();
        collections = new MissionCollections(client, Retention.FOR_EVER, Clock.systemUTC());
        writer = writer(collections);
    }

    private MissionWriter writer(MissionCollections to) {
        return new MissionWriter(
                new BulkSender<>(to, MongoAccess.Waits.of(Duration.ofMillis(100)), ignored -> {}),
                dead,
                client,
                UnregisteredMetricsGroup.createSinkWriterMetricGroup());
    }

    @AfterEach
    void stop() throws Exception {
        writer.close();
        mongo.close();
    }

    @Test
    void hasEverythingWrittenWhenACheckpointMayPass() throws Exception {
        for (int i = 0; i < 2_345; i++) {
            writer.write(Events.document("m", i), null);
        }
        writer.flush(false);

        assertThat(collections.get("mission_m").countDocuments()).isEqualTo(2_345);
        assertThat(dead.flushed).isTrue();
    }

    @Test
    void makesADeadLetterOfWhatTheServerRefusesBeforeACheckpointMayPass() throws Exception {
        collections
                .prepared("mission_m")
                .createIndex(Indexes.ascending("Temperature.value"), new IndexOptions().unique(true));
        for (int i = 0; i < 60; i++) { // of 40 different temperatures
            writer.write(Events.document("m", i), null);
        }
        writer.flush(false);

        assertThat(collections.get("mission_m").countDocuments()).isEqualTo(40);
        assertThat(dead.records).hasSize(20).allSatisfy(record -> {
            assertThat(record.topic()).isEqualTo("data.raw.dead");
            assertThat(record.headers())
                    .containsEntry(DeadLetter.REASON, "refused")
                    .containsEntry(DeadLetter.STAGE, "missions")
                    .containsEntry(DeadLetter.SOURCE, "data.raw-0@7");
            assertThat(new String(record.value(), UTF_8)).contains("\"Temperature\"");
        });
    }

    @Test
    void letsNoCheckpointPassWhileTheServerIsAway() throws Exception {
        writer.write(Events.document("m", 1), null);
        mongo.close();

        assertThatThrownBy(() -> writer.flush(false)).hasMessageContaining("MongoDB did not take documents");
        assertThat(dead.flushed).isFalse();
    }

    @Test
    void sendsWhatIsGatheredWithoutACheckpointToAServerThatIsIdle() {
        await().until(() -> {
            writer.write(Events.document("m", 1), null);
            return collections.get("mission_m").countDocuments() == 1;
        });
    }

    @Test
    void sendsManyDocumentsAtOnceToAServerThatIsIdle() throws Exception {
        for (int i = 0; i < 128; i++) {
            writer.write(Events.document("m", i), null);
        }

        await().until(() -> collections.get("mission_m").countDocuments() > 0);
    }

    @Test
    void letsACheckpointPassInTheTimeOfAFewAnswersHoweverManyMissionsThereAre() throws Exception {
        MongoClient slow = InterceptedMongo.answeringAfter(client, Duration.ofMillis(50));
        writer = writer(new MissionCollections(slow, Retention.FOR_EVER, Clock.systemUTC()));
        // A machine that is busy itself may need more than once.
        await().until(() -> {
            for (int i = 0; i < 1_050; i++) { // one bulk is under way, and the next is gathered
                writer.write(Events.document("m" + i % 50, i), null);
            }
            long begin = System.nanoTime();
            writer.flush(false);
            return System.nanoTime() - begin <= Duration.ofMillis(200).toNanos();
        });
    }

    private static final class CollectedDeadLetters implements SinkWriter<TopicRecord> {
        private final List<TopicRecord> records = new ArrayList<>();
        private boolean flushed;

        @Override
        public void write(TopicRecord record, Context context) {
            records.add(record);
        }

        @Override
        public void flush(boolean endOfInput) {
            flushed = true;
        }

        @Override
        public void close() {
            // nothing is open
        }
    }
}
