package io.furrow.embedded;

import java.nio.file.Path;
import java.time.Instant;
import java.util.ArrayList;
import java.util.Date;
import java.util.List;
import java.util.function.Consumer;
import java.util.stream.IntStream;

import com.mongodb.client.FindIterable;
import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.model.Filters;
import com.mongodb.client.model.Indexes;
import com.mongodb.client.model.Sorts;
import de.bwaldvogel.mongo.backend.IndexKey;
import de.bwaldvogel.mongo.backend.KeyValue;
import org.bson.Document;
import org.bson.conversions.Bson;
import org.h2.mvstore.MVMap;
import org.h2.mvstore.MVStore;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

/** A query by a date finds what it finds without an index: the same dates stand in a second field, which has none. */
class DateIndexTest {
    private static final String INDEXED = "_time";
    private static final String PLAIN = "plain";
    /** More than a page of an index holds. */
    private static final int MANY = 300;

    @TempDir
    Path directory;

    @Tag("full")
    @Test
    void findsWhatAScanFindsAlsoAfterChangesAndARestart() {
        with(farm -> {
            farm.createIndex(Indexes.ascending(INDEXED));
            IntStream.range(0, MANY).forEach(number -> farm.insertOne(document(number, date(number * 7 % MANY / 2))));
            farm.insertOne(document(MANY, null));
            farm.insertOne(document(MANY + 1, "2026"));
            farm.insertOne(document(MANY + 2, 7L));
            farm.insertOne(new Document("_id", "without"));
            assertSame(farm);

            farm.replaceOne(Filters.eq(3), document(3, date(1_000)));
            farm.replaceOne(Filters.eq(4), document(4, "no date any more"));
            farm.replaceOne(Filters.eq(MANY), document(MANY, date(-5)));
            farm.deleteMany(Filters.lt(INDEXED, date(10)));
            assertSame(farm);
        });
        with(farm -> {
            assertSame(farm);
            farm.insertOne(document(5_000, List.of(date(2), date(200))));
            assertSame(farm);
        });
    }

    @Test
    void forgetsADroppedCollection() {
        with(farm -> {
            farm.createIndex(Indexes.ascending(INDEXED));
            farm.insertOne(document(1, date(1)));
            farm.drop();
            farm.createIndex(Indexes.ascending(INDEXED));
            farm.insertOne(document(2, date(2)));
            assertSame(farm);
        });
    }

    @Test
    void readsNoMoreThanItIsRequested() {
        try (MVStore store = MVStore.open(null)) {
            MVMap<KeyValue, Object> entries =
                    store.openMap("index", new MVMap.Builder<KeyValue, Object>().keyType(new IndexKeyType()));
            DateIndex index = new DateIndex("by-time", new IndexKey(INDEXED, true), entries);
            IntStream.range(0, MANY)
                    .forEach(number -> index.add(entry(date(number).toInstant()), number, null));

            assertThat(index.keys(from(MANY - 2), order(1)).orElseThrow()).containsExactly(MANY - 2, MANY - 1);
            assertThat(index.keys(from(MANY - 2), order(-1)).orElseThrow()).containsExactly(MANY - 1, MANY - 2);
            assertThat(index.keys(from(0), order(-1)).orElseThrow().findFirst()).contains(MANY - 1);
            assertThat(index.keys(from(MANY - 2).append("id", "plough"), order(1))
                            .orElseThrow())
                    .containsExactly(MANY - 2, MANY - 1);
            assertThat(index.keys(from(0).append("_id", 7), order(1))).isEmpty();
            assertThat(index.keys(from(0), entry(1).append("id", 1))).isEmpty();
            assertThat(index.keys(entry(7), order(1))).isEmpty();

            index.add(entry(List.of()), MANY, null);
            assertThat(index.keys(from(0), order(1))).isEmpty();
        }
    }

    private static de.bwaldvogel.mongo.bson.Document entry(Object value) {
        return new de.bwaldvogel.mongo.bson.Document(INDEXED, value);
    }

    private static de.bwaldvogel.mongo.bson.Document from(int number) {
        return entry(new de.bwaldvogel.mongo.bson.Document("$gte", date(number).toInstant()));
    }

    private static de.bwaldvogel.mongo.bson.Document order(int direction) {
        return entry(direction);
    }

    private static void assertSame(MongoCollection<Document> farm) {
        List<Date> ends = List.of(new Date(Long.MIN_VALUE), date(20), date(120));
        for (Date from : ends) {
            assertSame(farm, Filters.gte(INDEXED, from), Filters.gte(PLAIN, from));
            assertSame(farm, Filters.lt(INDEXED, from), Filters.lt(PLAIN, from));
            assertSame(farm, Filters.eq(INDEXED, from), Filters.eq(PLAIN, from));
            for (Date to : ends) {
                assertSame(
                        farm,
                        Filters.and(Filters.gt(INDEXED, from), Filters.lte(INDEXED, to)),
                        Filters.and(Filters.gt(PLAIN, from), Filters.lte(PLAIN, to)));
                assertSame(
                        farm,
                        Filters.and(Filters.gt(INDEXED, from), Filters.ne(INDEXED, to), Filters.gt("number", 40)),
                        Filters.and(Filters.gt(PLAIN, from), Filters.ne(PLAIN, to), Filters.gt("number", 40)));
            }
        }
        assertSame(farm, Filters.ne(INDEXED, date(3)), Filters.ne(PLAIN, date(3)));
        assertSame(farm, new Document(), new Document());
    }

    private static void assertSame(MongoCollection<Document> farm, Bson indexed, Bson plain) {
        assertThat(farm.find(indexed)).as("%s", indexed).containsExactlyInAnyOrderElementsOf(farm.find(plain));
        assertThat(farm.countDocuments(indexed)).as("%s", indexed).isEqualTo(farm.countDocuments(plain));
        for (int limit : new int[] {0, 17}) {
            assertThat(times(farm.find(indexed).sort(Sorts.ascending(INDEXED)).limit(limit)))
                    .as("%s ascending", indexed)
                    .isEqualTo(
                            times(farm.find(plain).sort(Sorts.ascending(PLAIN)).limit(limit)));
            assertThat(times(farm.find(indexed)
                            .sort(Sorts.descending(INDEXED))
                            .skip(5)
                            .limit(limit)))
                    .as("%s descending", indexed)
                    .isEqualTo(times(farm.find(plain)
                            .sort(Sorts.descending(PLAIN))
                            .skip(5)
                            .limit(limit)));
        }
    }

    private static List<Object> times(FindIterable<Document> found) {
        List<Object> times = new ArrayList<>();
        found.forEach(document -> times.add(document.get(INDEXED)));
        return times;
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

    private static Date date(int minute) {
        return Date.from(Instant.parse("2026-01-02T03:04:05.678Z").plusSeconds(60L * minute));
    }

    private static Document document(int number, Object time) {
        return new Document("_id", number)
                .append("number", number)
                .append(INDEXED, time)
                .append(PLAIN, time);
    }
}
