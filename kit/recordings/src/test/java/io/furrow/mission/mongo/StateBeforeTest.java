package io.furrow.mission.mongo;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Random;
import java.util.Set;
import java.util.UUID;
import java.util.stream.IntStream;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.mongodb.ConnectionString;
import com.mongodb.MongoClientSettings;
import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.model.IndexOptions;
import com.mongodb.client.model.Indexes;
import com.mongodb.event.CommandListener;
import com.mongodb.event.CommandStartedEvent;
import com.mongodb.event.CommandSucceededEvent;
import org.bson.BsonArray;
import org.bson.BsonDocument;
import org.bson.BsonValue;
import org.bson.RawBsonDocument;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.embedded.EmbeddedMongo;
import io.furrow.mission.LatestState;
import io.furrow.mission.RecordingContract;
import io.furrow.mission.StoredEvent;
import io.furrow.model.event.HeaderNames;

import static org.assertj.core.api.Assertions.assertThat;

/** Runs on the embedded server, or on the one of {@code -Dfurrow.test.mongo=URI}; drops its database at the end. */
class StateBeforeTest {
    private static final String DATABASE = "test-" + UUID.randomUUID();
    private static final StateBefore.Bounds FEW = new StateBefore.Bounds(40, 3, 64, 1_000_000);
    private static final Set<String> ALL = Set.of();

    private static final List<String> QUERIES = new ArrayList<>();
    private static EmbeddedMongo embedded;
    private static MongoClient client;
    private static int returned;

    private MongoCollection<RawBsonDocument> mission;

    @BeforeAll
    static void connect() {
        String uri = System.getProperty("furrow.test.mongo");
        if (uri == null) {
            embedded = EmbeddedMongo.inMemory();
            uri = embedded.uri();
        }
        client = MongoClients.create(MongoClientSettings.builder()
                .applyConnectionString(new ConnectionString(uri))
                .addCommandListener(new Queries())
                .build());
    }

    @AfterAll
    static void dropDatabase() {
        client.getDatabase(DATABASE).drop();
        client.close();
        if (embedded != null) {
            embedded.close();
        }
    }

    @BeforeEach
    void begin() {
        mission = client.getDatabase(DATABASE).getCollection("mission_" + UUID.randomUUID(), RawBsonDocument.class);
        mission.createIndex(
                Indexes.ascending(EventDocumentCodec.ENTITY_ID, EventDocumentCodec.TIME),
                new IndexOptions().name(MissionCollections.BY_ENTITY));
        mission.createIndex(Indexes.ascending(EventDocumentCodec.TIME));
    }

    /** Records the queries of the driver. */
    private static final class Queries implements CommandListener {
        @Override
        public void commandStarted(CommandStartedEvent event) {
            BsonDocument command = event.getCommand();
            if (event.getCommandName().equals("aggregate")) {
                QUERIES.add("oldest by " + command.getString("hint").getValue());
            } else if (event.getCommandName().equals("find")) {
                QUERIES.add("%d by %s of %s"
                        .formatted(
                                command.getNumber("limit").intValue(),
                                command.getDocument("sort").toJson(),
                                entity(command)));
            } else if (event.getCommandName().equals("getMore")) {
                QUERIES.add("more");
            }
        }

        private static String entity(BsonDocument find) {
            return find.getDocument("filter").getArray("$and", new BsonArray()).stream()
                    .map(BsonValue::asDocument)
                    .filter(part -> part.containsKey("id"))
                    .map(part ->
                            part.get("id").isString() ? part.getString("id").getValue() : "some")
                    .findAny()
                    .orElse("all");
        }

        @Override
        public void commandSucceeded(CommandSucceededEvent event) {
            if (event.getResponse().containsKey("cursor")) {
                BsonDocument cursor = event.getResponse().getDocument("cursor");
                returned += cursor.containsKey("firstBatch")
                        ? cursor.getArray("firstBatch").size()
                        : cursor.getArray("nextBatch").size();
            }
        }
    }

    @Test
    void readsOnlyTheNewestDocumentsWhenAllEntitiesHaveReported() throws Exception {
        List<StoredEvent> events = IntStream.range(0, 1_000)
                .mapToObj(number -> event(number, 10 + number, "d" + number % 4, "x", "y"))
                .toList();
        store(events);

        assertThat(before(900, ALL, FEW)).contains(scanned(events, 900, ALL));
        assertThat(QUERIES).containsExactly("oldest by entity-and-event-time", "40 by {\"_time\": -1} of all");
        assertThat(returned).isEqualTo(4 + 40);
    }

    @Test
    void queriesASilentEntity() throws Exception {
        List<StoredEvent> events = new ArrayList<>();
        for (int number = 0; number < 1_000; number++) {
            String device = number < 100 ? "silent" : number % 2 == 0 ? "a" : "b";
            events.add(event(number, 10 + number, device, "x", "y"));
        }
        store(events);

        assertThat(before(900, ALL, FEW)).contains(scanned(events, 900, ALL));
        assertThat(QUERIES)
                .containsExactly(
                        "oldest by entity-and-event-time",
                        "40 by {\"_time\": -1} of all",
                        "16 by {\"_time\": -1} of silent");
        assertThat(returned).isEqualTo(3 + 40 + 16);
    }

    @Test
    void readsBackToTheDeletionOfAnEntityThatReportsOnlyChanges() throws Exception {
        List<StoredEvent> events = new ArrayList<>();
        for (int number = 0; number < 300; number++) {
            events.add(event(number, 10 + number, "d", number % 30 == 0 ? "battery" : "x"));
        }
        events.set(250, deleted(250, 260, "d"));
        store(events);

        assertThat(before(305, ALL, FEW)).contains(scanned(events, 305, ALL));
        assertThat(QUERIES)
                .containsExactly(
                        "oldest by entity-and-event-time",
                        "40 by {\"_time\": -1} of all",
                        "16 by {\"_time\": -1} of d",
                        "64 by {\"_time\": -1} of d");
    }

    @Test
    void givesUpOnEntitiesThatReportOnlyChangesAndOnTooManySilentOnes() throws Exception {
        List<StoredEvent> events = IntStream.range(0, 300)
                .mapToObj(number -> event(number, 10 + number, "d", number == 0 ? "battery" : "x"))
                .toList();
        store(events);
        assertThat(before(305, ALL, FEW)).isEmpty();

        for (int number = 300; number < 304; number++) {
            store(List.of(event(number, 1, "silent" + number, "x")));
        }
        QUERIES.clear();
        assertThat(before(305, ALL, FEW)).isEmpty();
        assertThat(QUERIES).hasSize(2);
    }

    @Test
    void readsFurtherWhenALimitSplitsAMillisecond() throws Exception {
        StoredEvent deletion = deleted(1, 10, "d");
        StoredEvent again = event(2, 10, "d", "z");
        for (List<StoredEvent> stored : List.of(List.of(deletion, again), List.of(again, deletion))) {
            begin();
            List<StoredEvent> events = new ArrayList<>(stored);
            for (int number = 3; number < 18; number++) {
                events.add(event(number, 10 + number, "d", number % 2 == 0 ? "x" : "y"));
            }
            for (StoredEvent event : events) {
                store(List.of(event));
            }

            assertThat(before(900, ALL, new StateBefore.Bounds(16, 3, 64, 1_000_000)))
                    .contains(scanned(events, 900, ALL));
        }
    }

    @Test
    void findsTheSameStateAsAScan() throws Exception {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        int found = 0;
        for (int round = 0; round < 30; round++) {
            begin();
            List<StoredEvent> events = mission(random);
            store(events);
            for (int i = 0; i < 4; i++) {
                long time = random.nextInt(1_100);
                Set<String> devices = random.nextInt(3) == 0 ? Set.of("d1", "d2", "d77") : ALL;
                long bytes = random.nextInt(3) == 0 ? 2_000 : FEW.bytes();
                Optional<List<StoredEvent>> state = before(time, devices, new StateBefore.Bounds(40, 3, 64, bytes));
                found += state.isPresent() ? 1 : 0;
                state.ifPresent(states -> assertThat(states)
                        .as("seed %d, before %d", seed, time)
                        .isEqualTo(scanned(events, time, devices)));
            }
        }
        assertThat(found).as("seed %d", seed).isGreaterThan(30);
    }

    /** Generates several events per millisecond, so that limits split some. */
    private static List<StoredEvent> mission(Random random) {
        List<StoredEvent> events = new ArrayList<>();
        for (int device = 1 + random.nextInt(5); device >= 0; device--) {
            Reporter reporter = Reporter.values()[random.nextInt(Reporter.values().length)];
            int since = random.nextInt(1_000);
            int count = 1 + random.nextInt(150);
            List<Integer> times = random.ints(count, since / 10, 100)
                    .map(time -> 10 * time)
                    .sorted()
                    .boxed()
                    .toList();
            int period = 2 + random.nextInt(5);
            boolean tenants = random.nextInt(8) == 0;
            for (int i = 0; i < count; i++) {
                int number = events.size();
                int time = times.get(i) + (i == 0 ? 0 : 5); // the first is the only one of its millisecond
                StoredEvent event = (!tenants || i % 2 == 1) && random.nextInt(25) == 0
                        ? deleted(number, time, "d" + device)
                        : event(number, time, "d" + device, reporter.attributes(i, period));
                events.add(tenants && i % 2 == 0 ? ofOtherTenant(event) : event);
            }
        }
        return events;
    }

    private static StoredEvent ofOtherTenant(StoredEvent event) {
        return new StoredEvent(
                event.id(), event.time(), event.entityId(), Map.of(HeaderNames.SERVICE, "barn"), event.entity());
    }

    /** How an entity reports its attributes. Numbers of one millisecond have the order of ids. */
    private enum Reporter {
        ONE_IN_TURN,
        WHOLE,
        ALL_EXCEPT_SOME,
        ONE_ONLY_AT_FIRST;

        String[] attributes(int number, int period) {
            return switch (this) {
                case ONE_IN_TURN -> new String[] {"abc".substring(number % 3, number % 3 + 1)};
                case WHOLE -> number < period ? new String[] {"a"} : new String[] {"a", "b"};
                case ALL_EXCEPT_SOME ->
                    number % period == 1 ? new String[] {number == 1 + period ? "d" : "c"} : new String[] {"a", "b"};
                case ONE_ONLY_AT_FIRST -> number == 0 ? new String[] {"z"} : new String[] {"a", "b"};
            };
        }
    }

    private Optional<List<StoredEvent>> before(long time, Set<String> entities, StateBefore.Bounds bounds)
            throws Exception {
        QUERIES.clear();
        returned = 0;
        return new StateBefore(mission, time, entities, bounds).read();
    }

    private static List<StoredEvent> scanned(List<StoredEvent> events, long time, Set<String> entities) {
        return LatestState.of(RecordingContract.ordered(events).stream()
                .filter(event -> event.time() < time)
                .filter(event -> entities.isEmpty() || entities.contains(event.entityId()))
                .toList());
    }

    private void store(List<StoredEvent> events) throws Exception {
        List<RawBsonDocument> documents = new ArrayList<>();
        for (StoredEvent event : RecordingContract.shuffled(events)) {
            documents.add(new RawBsonDocument(EventDocumentCodec.write(event)));
        }
        if (!documents.isEmpty()) {
            mission.insertMany(documents);
        }
    }

    private static StoredEvent event(int number, long time, String entityId, String... attributes) {
        ObjectNode entity = JsonNodeFactory.instance.objectNode();
        entity.put("id", entityId).put("type", "Robot");
        for (String attribute : attributes) {
            entity.putObject(attribute).put("type", "Number").put("value", number);
        }
        return new StoredEvent("e%04d".formatted(number), time, entityId, headers(number), entity);
    }

    private static StoredEvent deleted(int number, long time, String entityId) {
        return new StoredEvent("e%04d".formatted(number), time, entityId, headers(number), null);
    }

    private static Map<String, String> headers(int number) {
        return Map.of(HeaderNames.SERVICE, "farm", HeaderNames.TS_DEVICE, Integer.toString(1 + number));
    }
}
