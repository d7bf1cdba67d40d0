package io.furrow.ingest.mission;

import java.io.ByteArrayInputStream;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.time.Clock;
import java.time.Duration;
import java.time.Instant;
import java.time.ZoneOffset;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.UUID;
import java.util.stream.IntStream;

import com.mongodb.client.MongoClient;
import com.mongodb.client.model.IndexOptions;
import com.mongodb.client.model.Indexes;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.embedded.EmbeddedMongo;
import io.furrow.mission.archive.StoredMissions;
import io.furrow.mission.bulk.BulkSender;
import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.Retention;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/**
 * What missions ask of a server of MongoDB's protocol: of the embedded one, or of another by {@code -Dfurrow.test.mongo=URI}; its
 * collections have names of their own and go at the end.
 */
class AnyMongoTest {
    private final String mission = "test-" + UUID.randomUUID();
    private final String collection = MissionCollections.nameOf(mission);

    private EmbeddedMongo embedded;
    private String uri;
    private MongoClient client;
    private MissionCollections collections;

    @BeforeEach
    void connect() {
        uri = System.getProperty("furrow.test.mongo");
        if (uri == null) {
            embedded = EmbeddedMongo.inMemory();
            uri = embedded.uri();
        }
        client = new MongoAccess(uri, MongoAccess.Waits.of(Duration.ofSeconds(5))).open();
        collections = keeping(Retention.FOR_EVER);
    }

    @AfterEach
    void leaveNothingBehind() {
        collections.get(collection).drop();
        client.close();
        if (embedded != null) {
            embedded.close();
        }
    }

    @Test
    void keepsEachDocumentOnceHoweverOftenItIsWritten() throws Exception {
        List<MissionDocument> documents = readings(345);

        assertThat(send(documents)).isEmpty();
        assertThat(send(documents)).isEmpty();

        assertThat(collections.get(collection).countDocuments()).isEqualTo(345);
        assertThat(collections.indexes(collection)).containsKey("_id_");
    }

    @Test
    void refusesOneDocumentAndTakesTheOthersOfABulk() throws Exception {
        collections
                .prepared(collection)
                .createIndex(Indexes.ascending("Temperature.value"), new IndexOptions().unique(true));

        assertThat(send(readings(60))).as("of 40 different temperatures").hasSize(20);
        assertThat(collections.get(collection).countDocuments()).isEqualTo(40);
    }

    @Test
    void exportsWhatItImportedByteByByte() throws Exception {
        send(readings(300));
        String copy = mission + "-copy";
        try (StoredMissions missions = StoredMissions.open(uri)) {
            byte[] exported = exported(missions, mission);
            missions.importFrom(copy, new ByteArrayInputStream(exported), "copy", told -> {});

            assertThat(exported(missions, copy)).isEqualTo(exported).hasSizeGreaterThan(10_000);
            assertThat(missions.all())
                    .filteredOn(summary -> summary.mission().equals(mission))
                    .singleElement()
                    .satisfies(summary -> {
                        assertThat(summary.events()).isEqualTo(300);
                        assertThat(summary.bytes()).isPositive();
                        assertThat(summary.first()).isBefore(summary.last());
                    });
        } finally {
            collections.get(MissionCollections.nameOf(copy)).drop();
        }
    }

    @Test
    void hasTheServerOrThePurgeRemoveWhatIsOldAndFollowsAChangeOfTheRetention() throws Exception {
        var newest = Instant.ofEpochMilli(Events.reading(mission, 99).record().timestamp());
        Retention days = Retention.of(null, Map.of(mission, Duration.ofDays(30)));
        keeping(days).prepared(collection);
        send(readings(100));
        assertThat(retention())
                .isEqualTo(collections.serverExpires() ? Optional.of(Duration.ofDays(30)) : Optional.empty());

        Retention shorter = Retention.of(null, Map.of(mission, Duration.ofMinutes(1)));
        var changed = new MissionCollections(client, shorter, Clock.fixed(newest.plusSeconds(61), ZoneOffset.UTC));
        changed.prepared(collection);
        if (collections.serverExpires()) {
            assertThat(retention()).contains(Duration.ofMinutes(1));
        } else {
            assertThat(changed.purge()).isEqualTo(100);
            assertThat(collections.get(collection).countDocuments()).isZero();
        }
    }

    @Test
    void appliesAnotherRetentionToAMissionThatIsOverAndKeepsItAtAnImport() throws Exception {
        keeping(Retention.of(null, Map.of(mission, Duration.ofDays(30)))).prepared(collection);
        send(readings(10));
        Optional<Duration> kept = collections.serverExpires() ? Optional.of(Duration.ofDays(3650)) : Optional.empty();

        MongoAccess access = new MongoAccess(uri, MongoAccess.Waits.of(Duration.ofSeconds(5)));
        var purger = ExpiredDocumentsPurger.start(access, Retention.of(null, Map.of(mission, Duration.ofDays(3650))));
        try {
            await().untilAsserted(() -> assertThat(retention()).isEqualTo(kept));
        } finally {
            purger.close();
        }
        try (StoredMissions missions = StoredMissions.open(uri)) {
            byte[] exported = exported(missions, mission);
            missions.importFrom(mission, new ByteArrayInputStream(exported), "again", told -> {});
        }

        assertThat(retention()).isEqualTo(kept);
        assertThat(collections.get(collection).countDocuments()).isEqualTo(10);
    }

    private MissionCollections keeping(Retention retention) {
        return new MissionCollections(client, retention, Clock.systemUTC());
    }

    private Optional<Duration> retention() {
        return collections.indexes(collection).getOrDefault("event-time", Optional.empty());
    }

    private List<MissionDocument> readings(int number) {
        return IntStream.range(0, number)
                .mapToObj(i -> Events.document(mission, i))
                .toList();
    }

    private List<BulkSender.Refusal<MissionDocument>> send(List<MissionDocument> documents) throws Exception {
        return new BulkSender<MissionDocument>(collections, MongoAccess.Waits.of(Duration.ofSeconds(5)), ignored -> {})
                .send(documents);
    }

    private static byte[] exported(StoredMissions missions, String name) throws IOException {
        ByteArrayOutputStream out = new ByteArrayOutputStream();
        missions.export(name, out, told -> {});
        return out.toByteArray();
    }
}
