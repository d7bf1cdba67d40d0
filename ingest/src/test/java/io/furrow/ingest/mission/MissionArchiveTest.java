package io.furrow.ingest.mission;

import java.io.ByteArrayInputStream;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.nio.file.Files;
import java.time.Clock;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.Collections;
import java.util.Date;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.TreeMap;
import java.util.stream.Stream;

import com.mongodb.client.MongoClient;
import com.mongodb.client.model.Filters;
import org.apache.flink.core.fs.Path;
import org.bson.Document;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedMongo;
import io.furrow.mission.EventOrder;
import io.furrow.mission.StoredEvent;
import io.furrow.mission.archive.MissionArchive;
import io.furrow.mission.archive.MissionFiles;
import io.furrow.mission.archive.StoredMissions;
import io.furrow.mission.bulk.BulkSender;
import io.furrow.mission.file.ArchiveLine;
import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.Retention;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class MissionArchiveTest {
    private static final long DAY = Duration.ofDays(1).toMillis();

    @TempDir
    private java.nio.file.Path directory;

    private EmbeddedMongo mongo;
    private MongoClient client;
    private MissionCollections collections;
    private StoredMissions missions;

    @BeforeEach
    void start() {
        mongo = EmbeddedMongo.start(directory.resolve("mongo"));
        client = new MongoAccess(mongo.uri(), MongoAccess.Waits.of(Duration.ofSeconds(5))).open();
        collections = new MissionCollections(client, Retention.FOR_EVER, Clock.systemUTC());
        missions = StoredMissions.open(mongo.uri());
    }

    @AfterEach
    void stop() {
        missions.close();
        client.close();
        mongo.close();
    }

    @Test
    void givesTheSameBytesAfterExportAndImport() throws Exception {
        store(awkward());
        byte[] exported = exported("m");

        missions.importFrom("copy", new ByteArrayInputStream(exported), "test", ignored -> {});
        missions.importFrom("copy", new ByteArrayInputStream(exported), "test", ignored -> {});

        assertThat(new String(exported, UTF_8).lines()).hasSameSizeAs(awkward());
        assertThat(exported("copy")).isEqualTo(exported);
        assertThat(documents("mission_copy")).isEqualTo(documents("mission_m"));
    }

    @Test
    void exportsInTheOrderOfEventTimeWhateverTheOrderOfArrival() throws Exception {
        List<MissionEvent> shuffled = new ArrayList<>();
        for (int i = 0; i < 300; i++) {
            shuffled.add(Events.event("m", "e" + i, Events.TIME + i / 3, "{\"id\":\"t\"}"));
        }
        Collections.shuffle(shuffled, new Random(1));
        store(shuffled);

        List<StoredEvent> lines = new ArrayList<>();
        for (String line : new String(exported("m"), UTF_8).split("\n")) {
            lines.add(ArchiveLine.read(line));
        }
        assertThat(lines).hasSize(300).isSortedAccordingTo(EventOrder.COMPARATOR);
    }

    @Test
    void archivesEachDayOnceAndWhatComesLaterInAFurtherFile() throws Exception {
        Path root = new Path(directory.resolve("archive").toUri());
        MissionArchive archive = new MissionArchive(missions, root);
        store(List.of(at("a", 0), at("b", 1), at("c", DAY)));
        assertThat(archive.archive("m")).isEqualTo(new MissionArchive.Outcome(2, 3, 0));
        assertThat(archive.archive("m")).isEqualTo(new MissionArchive.Outcome(0, 0, 3));

        store(List.of(at("late", 0), at("d", DAY + 1)));
        assertThat(archive.archive("m")).isEqualTo(new MissionArchive.Outcome(2, 2, 3));
        assertThat(files(root)).containsExactly("""
                                2023-11-14-0001.ndjson.gz 2023-11-14-0002.ndjson.gz 2023-11-15-0001.ndjson.gz
                                2023-11-15-0002.ndjson.gz""".split("\\s+"));
    }

    @Test
    void givesBackFromTheArchiveWhatHasExpired() throws Exception {
        Path root = new Path(directory.resolve("archive").toUri());
        MissionArchive archive = new MissionArchive(missions, root);
        store(List.of(at("a", 0), at("b", 1), at("c", DAY)));
        byte[] whole = exported("m");
        archive.archive("m");
        collections.get("mission_m").deleteMany(Filters.eq("_id", "a"));

        assertThat(archive.archive("m")).isEqualTo(new MissionArchive.Outcome(0, 0, 2));
        MissionFiles.importFrom(missions, "m", archive.folder("m"), ignored -> {});

        assertThat(exported("m")).isEqualTo(whole);
    }

    @Test
    void writesTheSameCompressedFileAgain() throws Exception {
        store(awkward());
        Path file = new Path(directory.resolve("m.ndjson.gz").toUri());

        MissionFiles.write(file, out -> missions.export("m", out, ignored -> {}));
        byte[] first = Files.readAllBytes(directory.resolve("m.ndjson.gz"));
        MissionFiles.write(file, out -> missions.export("m", out, ignored -> {}));

        assertThat(Files.readAllBytes(directory.resolve("m.ndjson.gz"))).isEqualTo(first);
        assertThat(MissionFiles.importFrom(missions, "other", file, ignored -> {}))
                .isEqualTo(awkward().size());
        assertThat(exported("other")).isEqualTo(exported("m"));
    }

    @Test
    void leavesTheFileThatIsThereWhereAnExportFails() throws Exception {
        store(awkward());
        Path file = new Path(directory.resolve("files/m.ndjson.gz").toUri());
        MissionFiles.write(file, out -> missions.export("m", out, ignored -> {}));
        byte[] first = Files.readAllBytes(directory.resolve("files/m.ndjson.gz"));
        client.getDatabase("persistence")
                .getCollection("mission_m")
                .insertOne(new Document("_id", "z").append("_time", new Date(Events.TIME + DAY)));

        assertThatThrownBy(() -> MissionFiles.write(file, out -> missions.export("m", out, ignored -> {})))
                .hasMessageContaining("a document that ingest did not write");

        assertThat(Files.readAllBytes(directory.resolve("files/m.ndjson.gz"))).isEqualTo(first);
        assertThat(files(new Path(directory.resolve("files").toUri())))
                .as("nothing half-written stays")
                .containsExactly("m.ndjson.gz");
    }

    @Test
    void knowsAMissionByItsNameAndByWhatStandsForIt() throws Exception {
        String lengthy = "a very long name ".repeat(10);
        store(List.of(
                Events.event("field.7", "a", Events.TIME, "{\"id\":\"t\"}"),
                Events.event(
                        lengthy,
                        "b",
                        Events.TIME,
                        "{\"id\":\"t\",\"Mission\":{\"type\":\"String\",\"value\":\"" + lengthy + "\"}}"),
                Events.event("of service.devices ".repeat(10), "c", Events.TIME, "{\"id\":\"t\"}")));

        List<StoredMissions.Summary> all = missions.all();
        assertThat(all).extracting(StoredMissions.Summary::mission).contains("field.7", lengthy);
        assertThat(all).extracting(StoredMissions.Summary::mission).anyMatch(name -> name.startsWith("_h-"));
        for (StoredMissions.Summary summary : all) {
            String part = summary.collection().substring("mission_".length());
            assertThat(missions.has(summary.mission())).isTrue();
            assertThat(missions.has(part)).isTrue();
            assertThat(exported(part)).isEqualTo(exported(summary.mission())).isNotEmpty();
        }
        assertThat(missions.has("_h-" + "0".repeat(64))).isFalse();
    }

    @Test
    void tellsSizeTimesIndexesOfEachMission() throws Exception {
        store(awkward());

        assertThat(missions.all()).singleElement().satisfies(summary -> {
            assertThat(summary.mission()).isEqualTo("m");
            assertThat(summary.collection()).isEqualTo("mission_m");
            assertThat(summary.events()).isEqualTo(awkward().size());
            assertThat(summary.bytes()).isGreaterThan(100);
            assertThat(summary.first()).isEqualTo(Instant.EPOCH);
            assertThat(summary.last()).isEqualTo(Instant.ofEpochMilli(Events.TIME));
            assertThat(summary.indexes()).contains("event-time", "entity-and-event-time");
            assertThat(summary.retention()).isNull();
        });
    }

    @Test
    void saysWhichLineIsNoEvent() throws Exception {
        store(List.of(at("a", 0)));
        byte[] lines = (new String(exported("m"), UTF_8) + "{\"id\":1}\n").getBytes(UTF_8);

        assertThatThrownBy(() -> missions.importFrom("m", new ByteArrayInputStream(lines), "file.ndjson", n -> {}))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("file.ndjson, line 2 is not an event");
    }

    private static MissionEvent at(String id, long after) {
        return Events.event("m", id, Events.TIME + after, "{\"id\":\"t\",\"n\":{\"value\":1.50}}");
    }

    private static List<MissionEvent> awkward() {
        return List.of(
                Events.event(
                        "m",
                        "a",
                        Events.TIME,
                        "{\"id\":\"t\",\"n\":{\"value\":[1,1.0,1.10,1e3,5e0,12345678901234567890]}}"),
                Events.event(
                        "m",
                        "b",
                        Events.TIME,
                        "{\"id\":\"t\",\"a.b\":{\"value\":{\"$x\":null,\"\":\"\\u2028\\u0000\"}}}"),
                Events.event("m", "c", Events.TIME, null),
                Events.event(
                        "m",
                        "d",
                        0,
                        "{\"id\":\"ü\",\"type\":\"T\",\"_id\":{\"value\":-0.0},\"_time\":{\"value\":true}}"),
                Events.event(
                        "m", "e", Events.TIME, "{\"id\":\"t\",\"n\":{\"value\":1E-300},\"m\":{\"value\":4.9E-324}}"));
    }

    private void store(List<MissionEvent> events) throws Exception {
        List<MissionDocument> documents = new ArrayList<>();
        for (MissionEvent event : events) {
            documents.add(ComposeDocuments.compose(event));
        }
        assertThat(new BulkSender<MissionDocument>(
                                collections, MongoAccess.Waits.of(Duration.ofSeconds(5)), ignored -> {})
                        .send(documents))
                .isEmpty();
    }

    private byte[] exported(String mission) throws IOException {
        ByteArrayOutputStream out = new ByteArrayOutputStream();
        missions.export(mission, out, ignored -> {});
        return out.toByteArray();
    }

    private Map<String, String> documents(String collection) {
        Map<String, String> documents = new TreeMap<>();
        collections
                .get(collection)
                .find()
                .forEach(it -> documents.put(it.getString("_id").getValue(), it.toJson()));
        return documents;
    }

    private List<String> files(Path root) throws IOException {
        try (Stream<java.nio.file.Path> all = Files.walk(java.nio.file.Path.of(root.toUri()))) {
            return all.filter(Files::isRegularFile)
                    .map(it -> it.getFileName().toString())
                    .sorted()
                    .toList();
        }
    }
}
