package io.furrow.mission.mongo;

import java.lang.reflect.Proxy;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.UUID;
import java.util.concurrent.TimeUnit;
import java.util.stream.IntStream;

import com.mongodb.ConnectionString;
import com.mongodb.MongoClientSettings;
import com.mongodb.MongoExecutionTimeoutException;
import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.model.CountOptions;
import com.mongodb.event.CommandListener;
import com.mongodb.event.CommandStartedEvent;
import org.bson.BsonArray;
import org.bson.BsonBoolean;
import org.bson.BsonDateTime;
import org.bson.BsonDecimal128;
import org.bson.BsonDocument;
import org.bson.BsonInt32;
import org.bson.BsonObjectId;
import org.bson.BsonString;
import org.bson.RawBsonDocument;
import org.bson.types.Decimal128;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;

import io.furrow.embedded.EmbeddedMongo;
import io.furrow.mission.Cursor;
import io.furrow.mission.EventPage;
import io.furrow.mission.PageLimits;
import io.furrow.mission.RandomEvents;
import io.furrow.mission.Recording;
import io.furrow.mission.RecordingContract;
import io.furrow.mission.RecordingDeletedException;
import io.furrow.mission.RecordingExtent;
import io.furrow.mission.SkippedRecords;
import io.furrow.mission.StoredEvent;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** Runs on the embedded server, or on the one of {@code -Dfurrow.test.mongo=URI}; drops its database at the end. */
class MongoRecordingTest extends RecordingContract {
    private static final String DATABASE = "test-" + UUID.randomUUID();
    private static final PageLimits ALL = new PageLimits(1_000_000, Integer.MAX_VALUE);

    private static EmbeddedMongo embedded;
    private static String uri;
    private static MongoClient client;

    private final OrderedDocumentReader.Sizes sizes = new OrderedDocumentReader.Sizes(9, 0, 4, 700);

    @BeforeAll
    static void connect() {
        uri = System.getProperty("furrow.test.mongo");
        if (uri == null) {
            embedded = EmbeddedMongo.inMemory();
            uri = embedded.uri();
        }
        client = MongoAccess.open(uri, MongoAccess.SELECTION_TIMEOUT);
    }

    @AfterAll
    static void dropDatabase() {
        client.getDatabase(DATABASE).drop();
        client.close();
        if (embedded != null) {
            embedded.close();
        }
    }

    /** Uses small queries and a low limit of documents per millisecond. */
    @Override
    public Recording recorded(List<StoredEvent> events) throws Exception {
        MongoCollection<RawBsonDocument> collection = stored("mission_" + UUID.randomUUID(), events);
        return recording(collection);
    }

    private Recording recording(MongoCollection<RawBsonDocument> collection) {
        SharedMongoClient shared = SharedMongoClient.of(uri, MongoAccess.SELECTION_TIMEOUT);
        return new MongoRecording("m", shared, collection, "here", sizes);
    }

    @Override
    public int bytes(StoredEvent event) throws Exception {
        return EventDocumentCodec.write(event).length;
    }

    private static MongoCollection<RawBsonDocument> stored(String name, List<StoredEvent> events) throws Exception {
        client.getDatabase(DATABASE).createCollection(name);
        MongoCollection<RawBsonDocument> collection =
                client.getDatabase(DATABASE).getCollection(name, RawBsonDocument.class);
        List<RawBsonDocument> documents = new ArrayList<>();
        for (StoredEvent event : shuffled(events)) {
            documents.add(new RawBsonDocument(EventDocumentCodec.write(event)));
        }
        if (!documents.isEmpty()) {
            collection.insertMany(documents);
        }
        return collection;
    }

    @Test
    void opensStoredMissions() throws Exception {
        stored("mission_hoeing", List.of(RandomEvents.event("a", 1, 0)));
        stored("mission__x-a-2Eb", List.of(RandomEvents.event("b", 1, 0)));
        MongoRecordings recordings = new MongoRecordings(uri, DATABASE);

        assertThat(ids(recordings, "hoeing")).containsExactly("a");
        assertThat(ids(recordings, "a.b")).containsExactly("b");
        assertThat(ids(recordings, "_x-a-2Eb")).containsExactly("b");
        assertThat(recordings.open("weeding")).isEmpty();
    }

    @Test
    void doublesTheLimitWhileDocumentsAreSmall() throws Exception {
        List<StoredEvent> events = IntStream.range(0, 60)
                .mapToObj(i -> RandomEvents.event("e" + i, i, 0))
                .toList();
        MongoCollection<RawBsonDocument> collection = stored("mission_" + UUID.randomUUID(), events);
        int size = bytes(events.get(0));

        assertThat(limits(collection, Long.MAX_VALUE)).containsExactly(4, 8, 16, 32, 64);
        assertThat(limits(collection, 20L * size)).startsWith(4, 8, 16, 16, 16);
    }

    /** Returns the limits of the queries that read all documents. */
    private static List<Integer> limits(MongoCollection<RawBsonDocument> collection, long queryBytes) {
        List<Integer> limits = new ArrayList<>();
        CommandListener finds = new CommandListener() {
            @Override
            public void commandStarted(CommandStartedEvent event) {
                if (event.getCommandName().equals("find")) {
                    limits.add(event.getCommand().getNumber("limit").intValue());
                }
            }
        };
        MongoClientSettings settings = MongoClientSettings.builder()
                .applyConnectionString(new ConnectionString(uri))
                .addCommandListener(finds)
                .build();
        try (MongoClient watched = MongoClients.create(settings);
                OrderedDocumentReader documents = new OrderedDocumentReader(
                        watched.getDatabase(DATABASE)
                                .getCollection(collection.getNamespace().getCollectionName(), RawBsonDocument.class),
                        Cursor.START,
                        new OrderedDocumentReader.Sizes(4, queryBytes, 2, 700))) {
            for (int read = 0; read < 60; read++) {
                documents.peek();
                documents.remove();
            }
            assertThat(documents.peek()).isNull();
        }
        return limits;
    }

    @Test
    void readsAMillisecondAndAMissionLargerThanAQuery() throws Exception {
        List<StoredEvent> events = new ArrayList<>();
        for (int i = 0; i < 9_980; i++) {
            events.add(RandomEvents.event("e" + i, i, 0));
        }
        for (int i = 0; i < 1_200; i++) {
            events.add(RandomEvents.event("f" + i, i < 50 ? 9_990 : 9_991, 0));
        }
        stored("mission_large", events);
        try (Recording recording =
                new MongoRecordings(uri, DATABASE).open("large").orElseThrow()) {
            assertThat(recording.read(Cursor.START, ALL).events()).isEqualTo(ordered(events));
            assertThat(recording.read(Cursor.before(9_000), ALL).events()).hasSize(2_180);
        }
    }

    @Test
    void boundsTheDocumentsOfAMillisecondInMemory() throws Exception {
        List<StoredEvent> events = IntStream.range(0, 200)
                .mapToObj(i -> RandomEvents.event("e" + i, 1, i % 50 == 0 ? 4_000 : i % 7 * 100))
                .toList();
        MongoCollection<RawBsonDocument> collection = stored("mission_crowded", events);
        SameTimeCursor sameTime = new SameTimeCursor(collection, 1, Cursor.START, 2_000);
        List<StoredEvent> read = new ArrayList<>();
        while (sameTime.hasNext()) {
            List<OrderedDocumentReader.Ordered> some = sameTime.next();
            int bytes =
                    some.stream().mapToInt(OrderedDocumentReader.Ordered::bytes).sum();
            assertThat(some.size() == 1 || bytes <= 2_000)
                    .as("%d documents of %d bytes", some.size(), bytes)
                    .isTrue();
            for (OrderedDocumentReader.Ordered document : some) {
                read.add(document.event());
            }
        }
        assertThat(read).isEqualTo(ordered(events));
    }

    @Test
    void reportsInvalidDocumentsAndReadsTheOthers() throws Exception {
        MongoCollection<BsonDocument> collection = stored(
                        "mission_broken", List.of(RandomEvents.event("a", 1, 0), RandomEvents.event("z", 9, 0)))
                .withDocumentClass(BsonDocument.class);
        BsonDateTime time = new BsonDateTime(5);
        BsonString id = new BsonString("t1");
        collection.insertMany(List.of(
                new BsonDocument("_id", new BsonString("b-no-entity")).append("_time", time),
                new BsonDocument("_id", new BsonString("c-headers"))
                        .append("_time", time)
                        .append("id", id)
                        .append("_headers", new BsonInt32(1)),
                new BsonDocument("_id", new BsonString("d-deleted"))
                        .append("_time", time)
                        .append("id", id)
                        .append("_deleted", new BsonString("yes")),
                new BsonDocument("_id", new BsonString("e-decimal"))
                        .append("_time", time)
                        .append("id", id)
                        .append("n", new BsonDecimal128(Decimal128.parse("-0E+3"))),
                new BsonDocument("_id", new BsonObjectId())
                        .append("_time", time)
                        .append("id", id),
                new BsonDocument("_id", new BsonString(""))
                        .append("_time", time)
                        .append("id", id),
                new BsonDocument("_id", new BsonString("no-time")).append("id", id),
                new BsonDocument("_id", new BsonString("text-time"))
                        .append("_time", new BsonString("now"))
                        .append("id", id),
                new BsonDocument("_id", new BsonString("no-date"))
                        .append("_time", BsonBoolean.TRUE)
                        .append("id", id)));

        try (Recording recording =
                new MongoRecordings(uri, DATABASE).open("broken").orElseThrow()) {
            EventPage eventPage = recording.read(Cursor.START, ALL);

            assertThat(eventPage.events()).extracting(StoredEvent::id).containsExactly("a", "z");
            assertThat(eventPage.skipped())
                    .hasSize(7)
                    .anySatisfy(
                            skippedRecords -> assertThat(skippedRecords.what()).isEqualTo("document b-no-entity"))
                    .allSatisfy(skippedRecords ->
                            assertThat(skippedRecords.reason()).isNotBlank());
            assertThat(eventPage.skipped().get(0).count()).isEqualTo(3);
            assertThat(recording.read(Cursor.before(0), ALL).skipped()).hasSize(6);
        }
    }

    /** An array matches a comparison if one of its elements does. */
    @Test
    void skipsManyArraysOfTimes() throws Exception {
        MongoCollection<BsonDocument> collection = stored(
                        "mission_arrays",
                        List.of(
                                RandomEvents.event("a", 1, 0),
                                RandomEvents.event("b", 5, 0),
                                RandomEvents.event("z", 9, 0)))
                .withDocumentClass(BsonDocument.class);
        List<BsonDocument> arrays = new ArrayList<>();
        for (int i = 0; i < 30; i++) {
            BsonArray times = new BsonArray(List.of(new BsonDateTime(i % 2 == 0 ? 5 : 0), new BsonDateTime(10)));
            arrays.add(new BsonDocument("_id", new BsonString("array" + i))
                    .append("_time", times)
                    .append("id", new BsonString("t1")));
        }
        collection.insertMany(arrays);
        try (Recording recording = recording(collection.withDocumentClass(RawBsonDocument.class))) {
            EventPage eventPage = recording.read(Cursor.START, ALL);

            assertThat(eventPage.events()).extracting(StoredEvent::id).containsExactly("a", "b", "z");
            assertThat(eventPage.skipped()).extracting(SkippedRecords::count).containsExactly(30L);
            assertThat(recording.span()).contains(new RecordingExtent(1, 9));
            assertThat(recording.back(Cursor.before(20), Cursor.START, 2, event -> true, ALL))
                    .isEqualTo(new Cursor(1, "a"));
        }
    }

    @Test
    void stepsBackOverInvalidDocuments() throws Exception {
        MongoCollection<BsonDocument> collection = stored(
                        "mission_back", List.of(RandomEvents.event("a", 1, 0), RandomEvents.event("z", 9, 0)))
                .withDocumentClass(BsonDocument.class);
        collection.insertOne(new BsonDocument("_id", new BsonString("no-entity")).append("_time", new BsonDateTime(5)));
        try (Recording recording =
                new MongoRecordings(uri, DATABASE).open("back").orElseThrow()) {
            Cursor one = recording.back(Cursor.before(10), Cursor.START, 1, event -> true, ALL);

            assertThat(one).isEqualTo(new Cursor(1, "a"));
            assertThat(recording.back(one, Cursor.START, 1, event -> true, ALL)).isEqualTo(Cursor.START);
        }
    }

    @Test
    void sharesAClientUntilTheLastRecordingIsClosed() throws Exception {
        stored("mission_shared", List.of(RandomEvents.event("a", 1, 0), RandomEvents.event("b", 2, 0)));
        MongoRecordings recordings = new MongoRecordings(uri, DATABASE);
        int before = SharedMongoClient.open();
        Recording first = recordings.open("shared").orElseThrow();
        Recording second = recordings.open("shared").orElseThrow();
        assertThat(recordings.open("unknown")).isEmpty();
        assertThat(SharedMongoClient.open()).isEqualTo(before + 1);

        first.read(Cursor.START, new PageLimits(1, 1));
        first.close();
        first.close();

        assertThat(second.read(Cursor.START, ALL).events()).hasSize(2);
        second.close();
        assertThat(SharedMongoClient.open()).isEqualTo(before);
        assertThatThrownBy(() -> second.read(Cursor.START, ALL)).isInstanceOf(IllegalStateException.class);
    }

    @Test
    void reportsThatTheMissionWasDeleted() throws Exception {
        MongoCollection<RawBsonDocument> collection =
                stored("mission_going", List.of(RandomEvents.event("a", 1, 0), RandomEvents.event("b", 2, 0)));
        try (Recording recording =
                new MongoRecordings(uri, DATABASE).open("going").orElseThrow()) {
            EventPage first = recording.read(Cursor.START, new PageLimits(1, 1));
            assertThat(first.last()).isFalse();
            collection.drop();

            assertThatThrownBy(() -> recording.read(Cursor.after(first.events().get(0)), ALL))
                    .isInstanceOf(RecordingDeletedException.class)
                    .hasMessageContaining("Mission going has been deleted from MongoDB at 127.0.0.1");
        }
    }

    @Test
    void beginsWithoutTheCountOfDocumentsThatTakesTooLong() throws Exception {
        MongoCollection<RawBsonDocument> collection = stored("mission_slow", List.of(RandomEvents.event("a", 1, 0)));
        try (Recording recording = recording(slowToCount(collection))) {
            EventPage eventPage = recording.read(Cursor.START, ALL);

            assertThat(eventPage.events()).hasSize(1);
            assertThat(eventPage.skipped()).isEmpty();
        }
    }

    @SuppressWarnings("unchecked")
    private static MongoCollection<RawBsonDocument> slowToCount(MongoCollection<RawBsonDocument> collection) {
        return (MongoCollection<RawBsonDocument>) Proxy.newProxyInstance(
                MongoCollection.class.getClassLoader(),
                new Class<?>[] {MongoCollection.class},
                (proxy, method, arguments) -> {
                    if (!method.getName().equals("countDocuments")) {
                        return method.invoke(collection, arguments);
                    }
                    boolean isBounded =
                            arguments.length == 2 && ((CountOptions) arguments[1]).getMaxTime(TimeUnit.SECONDS) > 0;
                    assertThat(isBounded).isTrue();
                    throw new MongoExecutionTimeoutException(50, "operation exceeded time limit");
                });
    }

    @Test
    void readsEventsThatWereAddedAfterItsEnd() throws Exception {
        MongoCollection<RawBsonDocument> collection = stored("mission_growing", List.of(RandomEvents.event("a", 1, 0)));
        try (Recording recording =
                new MongoRecordings(uri, DATABASE).open("growing").orElseThrow()) {
            EventPage first = recording.read(Cursor.START, ALL);
            collection.insertOne(new RawBsonDocument(EventDocumentCodec.write(RandomEvents.event("b", 1, 0))));

            assertThat(first.last()).isTrue();
            assertThat(recording.read(first.next(), ALL).events())
                    .extracting(StoredEvent::id)
                    .containsExactly("b");
        }
    }

    private static List<String> ids(MongoRecordings recordings, String mission) throws Exception {
        Optional<Recording> opened = recordings.open(mission);
        try (Recording recording = opened.orElseThrow()) {
            return recording.read(Cursor.START, ALL).events().stream()
                    .map(StoredEvent::id)
                    .toList();
        }
    }
}
