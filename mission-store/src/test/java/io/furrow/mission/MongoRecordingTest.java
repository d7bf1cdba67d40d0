package io.furrow.mission;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.UUID;

import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoCollection;
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

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** On the embedded server, or on another by {@code -Dfurrow.test.mongo=URI}; its database goes at the end. */
class MongoRecordingTest extends RecordingContract {
    private static final String DATABASE = "test-" + UUID.randomUUID();
    private static final PageLimits ALL = new PageLimits(1_000_000, Integer.MAX_VALUE);

    private static EmbeddedMongo embedded;
    private static String uri;
    private static MongoClient client;

    private final OrderedDocuments.Sizes sizes = new OrderedDocuments.Sizes(9, 4, 700);

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
    static void leaveNothingBehind() {
        client.getDatabase(DATABASE).drop();
        client.close();
        if (embedded != null) {
            embedded.close();
        }
    }

    /** Every query is short, and few events of one millisecond are a crowd. */
    @Override
    Recording recorded(List<StoredEvent> events) throws Exception {
        MongoCollection<RawBsonDocument> collection = stored("mission_" + UUID.randomUUID(), events);
        MongoClient own = MongoAccess.open(uri, MongoAccess.SELECTION_TIMEOUT);
        return new MongoRecording(
                "m",
                own,
                own.getDatabase(DATABASE)
                        .getCollection(collection.getNamespace().getCollectionName(), RawBsonDocument.class),
                "here",
                sizes);
    }

    @Override
    int bytes(StoredEvent event) throws Exception {
        return DocumentForm.write(event).length;
    }

    private static MongoCollection<RawBsonDocument> stored(String name, List<StoredEvent> events) throws Exception {
        client.getDatabase(DATABASE).createCollection(name);
        MongoCollection<RawBsonDocument> collection =
                client.getDatabase(DATABASE).getCollection(name, RawBsonDocument.class);
        List<RawBsonDocument> documents = new ArrayList<>();
        for (StoredEvent event : shuffled(events)) {
            documents.add(new RawBsonDocument(DocumentForm.write(event)));
        }
        if (!documents.isEmpty()) {
            collection.insertMany(documents);
        }
        return collection;
    }

    @Test
    void knowsTheMissionsThatAreStored() throws Exception {
        stored("mission_hoeing", List.of(RandomEvents.event("a", 1, 0)));
        stored("mission__x-a-2Eb", List.of(RandomEvents.event("b", 1, 0)));
        MongoRecordings recordings = new MongoRecordings(uri, DATABASE);

        assertThat(ids(recordings, "hoeing")).containsExactly("a");
        assertThat(ids(recordings, "a.b")).containsExactly("b");
        assertThat(ids(recordings, "_x-a-2Eb")).containsExactly("b");
        assertThat(recordings.open("weeding")).isEmpty();
    }

    @Test
    void readsAMillisecondAndAMissionThatAreLargerThanAQuery() throws Exception {
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
    void namesTheDocumentsThatHoldNoEventAndReadsTheOthers() throws Exception {
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
            Page page = recording.read(Cursor.START, ALL);

            assertThat(page.events()).extracting(StoredEvent::id).containsExactly("a", "z");
            assertThat(page.skipped())
                    .hasSize(7)
                    .anySatisfy(skipped -> assertThat(skipped.what()).isEqualTo("document b-no-entity"))
                    .allSatisfy(skipped -> assertThat(skipped.reason()).isNotBlank());
            assertThat(page.skipped().get(0).count()).isEqualTo(3);
            assertThat(recording.read(Cursor.before(0), ALL).skipped()).hasSize(6);
        }
    }

    @Test
    void tellsThatTheMissionHasGone() throws Exception {
        MongoCollection<RawBsonDocument> collection =
                stored("mission_going", List.of(RandomEvents.event("a", 1, 0), RandomEvents.event("b", 2, 0)));
        try (Recording recording =
                new MongoRecordings(uri, DATABASE).open("going").orElseThrow()) {
            Page first = recording.read(Cursor.START, new PageLimits(1, 1));
            assertThat(first.last()).isFalse();
            collection.drop();

            assertThatThrownBy(() -> recording.read(Cursor.after(first.events().get(0)), ALL))
                    .isInstanceOf(RecordingGoneException.class)
                    .hasMessageContaining("Mission going has been deleted from MongoDB at 127.0.0.1");
        }
    }

    @Test
    void goesOnWhereEventsWereAddedAfterItsEnd() throws Exception {
        MongoCollection<RawBsonDocument> collection = stored("mission_growing", List.of(RandomEvents.event("a", 1, 0)));
        try (Recording recording =
                new MongoRecordings(uri, DATABASE).open("growing").orElseThrow()) {
            Page first = recording.read(Cursor.START, ALL);
            collection.insertOne(new RawBsonDocument(DocumentForm.write(RandomEvents.event("b", 1, 0))));

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
