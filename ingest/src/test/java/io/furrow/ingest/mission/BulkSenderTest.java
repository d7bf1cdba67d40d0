package io.furrow.ingest.mission;

import java.io.IOException;
import java.nio.file.Path;
import java.time.Clock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.atomic.AtomicLong;
import java.util.stream.IntStream;

import com.mongodb.client.MongoClient;
import com.mongodb.client.model.IndexOptions;
import com.mongodb.client.model.Indexes;
import org.bson.Document;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedMongo;
import io.furrow.mission.bulk.BulkSender;
import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.Retention;
import io.furrow.unchecked.Unchecked;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

@Tag("full")
class BulkSenderTest {
    private final AtomicLong retried = new AtomicLong();

    @TempDir
    private Path directory;

    @AutoClose
    private EmbeddedMongo mongo;

    private MongoAccess access;

    @AutoClose
    private MongoClient client;

    private MissionCollections collections;

    @BeforeEach
    void start() {
        mongo = EmbeddedMongo.start(directory);
        connect(Retention.FOR_EVER);
    }

    private void connect(Retention retention) {
        access = new MongoAccess(
                mongo.uri() + "/?serverSelectionTimeoutMS=2000", MongoAccess.Waits.of(Duration.ofSeconds(20)));
        client = access.open();
        collections = new MissionCollections(client, retention, Clock.systemUTC());
    }

    @Test
    void writesADocumentOnceHoweverOftenItIsSent() throws Exception {
        List<MissionDocument> documents = documents(0, 50);

        assertThat(sender().send(documents)).isEmpty();
        assertThat(sender().send(documents)).isEmpty();

        assertThat(ids()).hasSize(50);
        assertThat(collections.get("mission_m").find().first())
                .isEqualTo(new org.bson.RawBsonDocument(documents.get(0).bson()));
    }

    @Test
    void keepsEachMissionInItsCollection() throws Exception {
        sender().send(List.of(Events.document("a", 1), Events.document("b", 2), Events.document("a", 3)));

        assertThat(collections.names()).containsExactly("mission_a", "mission_b");
        assertThat(collections.get("mission_a").countDocuments()).isEqualTo(2);
    }

    @Test
    void makesTheIndexesOfACollectionAtItsFirstUse() throws Exception {
        sender().send(documents(0, 1));

        List<String> keys = new ArrayList<>();
        collections
                .get("mission_m")
                .listIndexes()
                .forEach(index -> keys.add(index.get("key").toString()));
        assertThat(keys)
                .contains(
                        new Document("_time", 1).toString(),
                        new Document("id", 1).append("_time", 1).toString());
    }

    @Test
    void givesBackWhatTheServerRefusesAndWritesTheRest() throws Exception {
        sender().send(documents(0, 1));
        collections
                .get("mission_m")
                .createIndex(Indexes.ascending("Temperature.value"), new IndexOptions().unique(true));

        List<BulkSender.Refusal<MissionDocument>> refused =
                sender().send(documents(1, 60)); // 40 different temperatures

        assertThat(ids()).hasSize(40);
        assertThat(refused).hasSize(20).allSatisfy(refusal -> {
            assertThat(refusal.reason()).contains("duplicate key");
            assertThat(ids()).doesNotContain(refusal.document().id());
        });
        assertThat(retried).hasValue(0);
    }

    @Test
    void findsTheOneDocumentAtWhichTheServerBreaksOff() throws Exception {
        List<MissionDocument> documents = new ArrayList<>(documents(0, 9));
        var unfit = new MissionDocument("mission_m", "unfit", new byte[] {9, 0, 0, 0, 1, 'x', 0, 0, 0}, null);
        documents.add(4, unfit);

        List<BulkSender.Refusal<MissionDocument>> refused = sender().send(documents);

        assertThat(refused)
                .singleElement()
                .satisfies(refusal -> assertThat(refusal.document()).isSameAs(unfit));
        assertThat(ids()).hasSize(9);
    }

    @Test
    void takesAFailureToMakeAnIndexForNoFaultOfADocument() throws Exception {
        AtomicInteger refusals = new AtomicInteger(3); // another writer drops the index that this one is about to drop
        collections = new MissionCollections(
                InterceptedMongo.refusingIndexes(client, refusals), Retention.FOR_EVER, Clock.systemUTC());

        assertThat(sender().send(documents(0, 1))).isEmpty();

        assertThat(refusals).hasValue(0);
        assertThat(ids()).hasSize(1);
    }

    @Test
    void triesAgainUntilTheServerIsBack() throws Exception {
        sender().send(documents(0, 10));
        int port = Integer.parseInt(mongo.uri().substring(mongo.uri().lastIndexOf(':') + 1));
        mongo.close();
        CompletableFuture<List<BulkSender.Refusal<MissionDocument>>> sent =
                CompletableFuture.supplyAsync(() -> Unchecked.get(() -> sender().send(documents(10, 20))));
        org.awaitility.Awaitility.await().until(() -> retried.get() > 0);

        mongo = EmbeddedMongo.start(directory, port);

        assertThat(sent.get(60, TimeUnit.SECONDS)).isEmpty();
        assertThat(ids()).hasSize(20);
    }

    @Test
    void failsWhenTheServerStaysAway() {
        mongo.close();

        assertThatThrownBy(() -> new BulkSender<MissionDocument>(
                                collections, MongoAccess.Waits.of(Duration.ofMillis(200)), retried::addAndGet)
                        .send(documents(0, 3)))
                .isInstanceOf(IOException.class)
                .hasMessageContainingAll("MongoDB did not take documents", "--mongo");
    }

    @Test
    void removesWhatHasExpiredWhereTheServerDoesNot() throws Exception {
        client.close();
        connect(Retention.of(Duration.ofDays(1), java.util.Map.of("kept", Duration.ofDays(100_000 / 5))));
        MissionDocument today =
                ComposeDocuments.compose(Events.event("m", "new", System.currentTimeMillis(), "{\"id\":\"t\"}"));
        sender().send(List.of(Events.document("m", 1), Events.document("kept", 1), today));

        assertThat(collections.serverExpires()).isFalse();
        assertThat(collections.purge()).isEqualTo(1);

        assertThat(ids()).containsExactly("new");
        assertThat(collections.get("mission_kept").countDocuments()).isEqualTo(1);
    }

    @Test
    void tellsTheServerWhatExpiresWhereTheServerRemovesIt() throws Exception {
        Retention retention = Retention.of(null, java.util.Map.of("m", Duration.ofDays(7)));
        collections = new MissionCollections(client, retention, Clock.systemUTC(), true);

        sender().send(List.of(Events.document("m", 1), Events.document("other", 1)));

        assertThat(expiresAfter("mission_m")).containsExactly(Duration.ofDays(7).toSeconds());
        assertThat(expiresAfter("mission_other")).isEmpty();
    }

    private List<Long> expiresAfter(String collection) {
        List<Long> seconds = new ArrayList<>();
        for (Document index : collections.get(collection).listIndexes()) {
            if (index.get("expireAfterSeconds") instanceof Number after) {
                seconds.add(after.longValue());
            }
        }
        return seconds;
    }

    private BulkSender<MissionDocument> sender() {
        return new BulkSender<>(collections, access.waits(), retried::addAndGet);
    }

    private List<String> ids() {
        List<String> ids = new ArrayList<>();
        collections
                .get("mission_m")
                .find()
                .forEach(it -> ids.add(it.getString("_id").getValue()));
        return ids;
    }

    private static List<MissionDocument> documents(int from, int to) {
        return IntStream.range(from, to).mapToObj(n -> Events.document("m", n)).toList();
    }
}
