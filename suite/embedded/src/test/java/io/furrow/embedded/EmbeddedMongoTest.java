package io.furrow.embedded;

import java.nio.file.Path;
import java.time.Instant;
import java.util.ArrayList;
import java.util.Date;
import java.util.List;
import java.util.function.Consumer;
import java.util.stream.IntStream;

import com.mongodb.MongoWriteException;
import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.model.Filters;
import com.mongodb.client.model.ReplaceOptions;
import com.mongodb.client.model.Sorts;
import org.bson.Document;
import org.bson.types.Binary;
import org.bson.types.ObjectId;
import org.h2.mvstore.MVMap;
import org.h2.mvstore.MVStore;
import org.h2.mvstore.Page;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** What was acknowledged is there after a restart, also of another release. */
class EmbeddedMongoTest {
    /** More than a page of an index holds. */
    private static final int MANY = 300;

    @TempDir
    Path directory;

    @Test
    void givesBackEachKindOfValueAndIdAfterARestart() {
        List<Object> ids = List.of(
                "an event",
                7,
                7_000_000_000L,
                0.5,
                new ObjectId(),
                new Document("domain", "farm").append("number", 1),
                true);
        List<Document> documents = new ArrayList<>();
        ids.forEach(id -> documents.add(ofEachKind(id)));

        with(farm -> farm.insertMany(documents));

        with(farm -> {
            assertThat(farm.find()).containsExactlyInAnyOrderElementsOf(documents);
            ids.forEach(id -> assertThat(farm.find(Filters.eq(id)).first()).isEqualTo(ofEachKind(id)));
        });
    }

    /** PyMongo 4.20 wants 9 at least, drivers in a year will want more. */
    @ParameterizedTest
    @ValueSource(strings = {"isMaster", "hello"})
    void greetsDriversWithTheProtocolOfTheVersionThatItReports(String greeting) {
        try (EmbeddedMongo mongo = EmbeddedMongo.start(directory);
                MongoClient client = MongoClients.create(mongo.uri())) {
            Document answer = client.getDatabase("admin").runCommand(new Document(greeting, 1));

            assertThat(answer.getInteger("maxWireVersion")).isEqualTo(13);
        }
    }

    @Test
    void goesOnWithItsFile() {
        with(farm -> IntStream.range(0, MANY).forEach(number -> farm.insertOne(event(number, "old"))));

        with(farm -> {
            IntStream.range(0, MANY)
                    .forEach(number -> assertThat(
                                    farm.find(Filters.eq(id(number))).first())
                            .isEqualTo(event(number, "old")));
            IntStream.range(0, MANY)
                    .filter(number -> number % 3 == 0)
                    .forEach(number -> replace(farm, event(number, "new")));
            assertThatThrownBy(() -> farm.insertOne(event(1, "twice"))).isInstanceOf(MongoWriteException.class);
            IntStream.range(MANY, 2 * MANY).forEach(number -> replace(farm, event(number, "new")));
        });

        with(farm -> {
            assertThat(farm.countDocuments()).isEqualTo(2 * MANY);
            IntStream.range(0, 2 * MANY)
                    .forEach(number -> assertThat(
                                    farm.find(Filters.eq(id(number))).first())
                            .isEqualTo(event(number, number < MANY && number % 3 > 0 ? "old" : "new")));
        });
    }

    @Test
    void sortsWhatAQueryWithALimitReturns() {
        with(farm -> {
            IntStream.range(0, MANY)
                    .map(number -> number * 7 % MANY)
                    .forEach(number -> farm.insertOne(new Document("_id", "e" + number)
                            .append("number", number)
                            .append("half", number / 2)));

            assertThat(numbers(farm.find().sort(Sorts.ascending("number")).limit(3)))
                    .containsExactly(0, 1, 2);
            assertThat(numbers(farm.find(Filters.lt("number", 200))
                            .sort(Sorts.descending("half", "number"))
                            .skip(2)
                            .limit(3)))
                    .containsExactly(197, 196, 195);
            assertThat(numbers(farm.find().sort(Sorts.descending("number")).limit(2 * MANY)))
                    .hasSize(MANY)
                    .startsWith(MANY - 1);
            assertThat(farm.find().sort(Sorts.descending("number")).first().getInteger("number"))
                    .isEqualTo(MANY - 1);
        });
    }

    private static List<Integer> numbers(Iterable<Document> found) {
        List<Integer> numbers = new ArrayList<>();
        found.forEach(document -> numbers.add(document.getInteger("number")));
        return numbers;
    }

    /** Else a cache of 48 MB takes a heap. */
    @Test
    void countsWhatDocumentsTakeOnTheHeapAlsoAfterSmallerOnes() {
        DocumentType type = new DocumentType();
        de.bwaldvogel.mongo.bson.Document large = new de.bwaldvogel.mongo.bson.Document("text", "x".repeat(50_000));
        try (MVStore store = MVStore.open(directory.resolve("pages.mv").toString())) {
            MVMap<Integer, de.bwaldvogel.mongo.bson.Document> map = store.openMap(
                    "farm", new MVMap.Builder<Integer, de.bwaldvogel.mongo.bson.Document>().valueType(type));
            IntStream.range(0, 2_000)
                    .forEach(number -> map.put(number, new de.bwaldvogel.mongo.bson.Document("text", "x")));
            IntStream.range(2_000, 2_100).forEach(number -> map.put(number, large));

            Page<?, ?> last = map.getRootPage();
            while (!last.isLeaf()) {
                last = last.getChildPage(last.getRawChildPageCount() - 1);
            }
            assertThat(last.getMemory()).isGreaterThanOrEqualTo(last.getKeyCount() * type.getMemory(large));
        }
    }

    private void with(Consumer<MongoCollection<Document>> action) {
        try (EmbeddedMongo mongo = EmbeddedMongo.start(directory)) {
            use(mongo.uri(), action);
        }
    }

    private static void use(String uri, Consumer<MongoCollection<Document>> action) {
        try (MongoClient client = MongoClients.create(uri)) {
            action.accept(client.getDatabase("missions").getCollection("farm"));
        }
    }

    private static void replace(MongoCollection<Document> farm, Document document) {
        farm.replaceOne(Filters.eq(document.get("_id")), document, new ReplaceOptions().upsert(true));
    }

    private static Document event(int number, String state) {
        return new Document("_id", id(number)).append("state", state);
    }

    /** In an order of their own, and of several lengths. */
    private static String id(int number) {
        return Integer.toHexString(number * 0x9E3779B1);
    }

    private static Document ofEachKind(Object id) {
        return new Document("_id", id)
                .append("text", "µ € \u0000 𝄞")
                .append("number", 21.5)
                .append("int", -3)
                .append("long", Long.MIN_VALUE)
                .append("flag", false)
                .append("none", null)
                .append("_time", Date.from(Instant.parse("2026-01-02T03:04:05.678Z")))
                .append("bytes", new Binary(new byte[] {0, -1, 127}))
                .append("list", List.of(1, "two", new Document("three", 3.0), List.of()))
                .append("inner", new Document("a", new Document()));
    }
}
