package io.furrow.cli;

import java.io.ByteArrayInputStream;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.EmbeddedMongo;
import io.furrow.embedded.FreePort;
import io.furrow.mission.archive.StoredMissions;
import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

@Tag("full")
class CatalogIT {
    @TempDir
    static Path folder;

    @AutoClose
    private static EmbeddedKafka kafka;

    @BeforeAll
    static void start() throws Exception {
        kafka = EmbeddedKafka.start(folder, 0);
    }

    @Test
    void showsTheNewestOfEachEntryAndNothingWhereThereIsNothing() throws Exception {
        assertThat(output("catalog", "--kafka", kafka.bootstrapServers())).startsWith("Nothing is stored yet.");

        write("farm|north|weeding|Thermometer", "weeding", 1);
        write("farm|north|sowing|Camera", "sowing", 5);
        write("farm|north|weeding|Thermometer", "weeding", 2);
        write("farm|north|old|Camera", "old", 9);
        write("farm|north|old|Camera", null, 0);

        List<JsonNode> all = json("catalog", "--kafka", kafka.bootstrapServers(), "--output", "json");
        assertThat(all)
                .extracting(entry -> entry.path("mission").asText() + " "
                        + entry.path("events").asInt())
                .containsExactly("sowing 5", "weeding 2");
        assertThat(json("catalog", "--kafka", kafka.bootstrapServers(), "--output", "json", "--mission", "weeding"))
                .hasSize(1);
        assertThat(output("catalog", "--kafka", kafka.bootstrapServers()).lines())
                .anyMatch(line -> line.startsWith("north / weeding"));
    }

    @Test
    void listsTheMissionsAndImagesThatAreStoredAndForgetsThoseThatAreGone() throws Exception {
        String lines = """
                {"id":"a","time":1700000000000,"headers":{},"entity":{"id":"t","type":"T"}}
                {"id":"b","time":1700000060000,"headers":{},"entity":{"id":"t","type":"T"}}
                """;
        Path root = folder.resolve("images");
        Path image = root.resolve("north/weeding/cam-1/cam-1_20231114221320123.png");
        Files.createDirectories(image.getParent());
        Files.write(image, new byte[1500]);
        Files.write(image.resolveSibling("cam-1_20231114221321123.jpg"), new byte[500]);
        Files.write(image.resolveSibling(".unfinished-x"), new byte[500]);
        try (EmbeddedMongo mongo = EmbeddedMongo.inMemory();
                StoredMissions missions = StoredMissions.open(mongo.uri());
                MongoClient client = MongoClients.create(mongo.uri())) {
            missions.importFrom("weeding", new ByteArrayInputStream(lines.getBytes(UTF_8)), "lines", told -> {});
            String[] command = {
                "catalog", "--kafka", kafka.bootstrapServers(), "--mongo", mongo.uri(), "--images", root.toString()
            };

            JsonNode all =
                    NgsiJson.read(output(with(command, "--output", "json")).getBytes(UTF_8));
            assertThat(all.path("missions")).singleElement().satisfies(mission -> {
                assertThat(mission.path("mission").asText()).isEqualTo("weeding");
                assertThat(mission.path("collection").asText()).isEqualTo("mission_weeding");
                assertThat(mission.path("documents").asLong()).isEqualTo(2);
                assertThat(mission.path("bytes").asLong()).isPositive();
                assertThat(mission.path("first").asText()).isEqualTo("2023-11-14T22:13:20Z");
                assertThat(mission.path("last").asText()).isEqualTo("2023-11-14T22:14:20Z");
                assertThat(mission.path("indexes")).isNotEmpty();
                assertThat(mission.has("retentionSeconds")).isFalse();
            });
            assertThat(all.path("images").toString())
                    .isEqualTo(
                            "[{\"domain\":\"north\",\"mission\":\"weeding\",\"entities\":1,\"images\":2,\"bytes\":2000}]");
            assertThat(output(command).lines())
                    .anyMatch(line -> line.matches("weeding +2 +.*2023-11-14T22:13:20Z +2023-11-14T22:14:20Z +- .*"))
                    .anyMatch(line -> line.matches("north / weeding +1 +2 +2.0 kB"));

            client.getDatabase("persistence").getCollection("mission_weeding").drop();
            Files.delete(image);
            Files.delete(image.resolveSibling("cam-1_20231114221321123.jpg"));
            JsonNode after =
                    NgsiJson.read(output(with(command, "--output", "json")).getBytes(UTF_8));
            assertThat(after.path("missions")).isEmpty();
            assertThat(after.path("images")).isEmpty();
        }
    }

    @Test
    void reportsWhatOfTheStoresDoesNotAnswer() {
        String[] kafkaOnly = {"catalog", "--kafka", kafka.bootstrapServers()};
        String nobody = "mongodb://127.0.0.1:" + FreePort.orFree(0) + "/?serverSelectionTimeoutMS=500";

        assertThat(output(with(kafkaOnly, "--mongo", nobody))).contains("Check that it runs, and --mongo.");
        assertThat(output(with(kafkaOnly, "--images", folder.resolve("nothing").toString())))
                .contains("is not there; name the folder of --images");
    }

    private static String[] with(String[] command, String... more) {
        return Stream.concat(Arrays.stream(command), Arrays.stream(more)).toArray(String[]::new);
    }

    @Test
    void reportsThatKafkaDoesNotAnswer() {
        assertThat(output("catalog", "--kafka", "127.0.0.1:" + FreePort.orFree(0)))
                .contains("cannot be read", "Check the address given with --kafka");
    }

    private static void write(String key, String mission, int events) throws Exception {
        byte[] value = mission == null
                ? null
                : "{\"service\":\"farm\",\"domain\":\"north\",\"mission\":\"%s\",\"type\":\"T\",\"events\":%d}"
                        .formatted(mission, events)
                        .getBytes(UTF_8);
        try (KafkaProducer<String, byte[]> producer = new KafkaProducer<>(
                Map.of("bootstrap.servers", kafka.bootstrapServers()),
                new StringSerializer(),
                new ByteArraySerializer())) {
            producer.send(new ProducerRecord<>("data.catalog", key, value)).get();
        }
    }

    private static List<JsonNode> json(String... args) throws Exception {
        List<JsonNode> entries = new ArrayList<>();
        NgsiJson.read(output(args).getBytes(UTF_8)).path("types").forEach(entries::add);
        return entries;
    }

    private static String output(String... args) {
        StringWriter output = new StringWriter();
        CommandLine line = Commands.commandLine(CommandSpec.create().name("furrow"), Commands.ALL);
        line.setOut(new PrintWriter(output)).setErr(new PrintWriter(output));
        line.execute(args);
        return output.toString();
    }
}
