package io.furrow.ingest;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.stream.Stream;

import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import picocli.CommandLine.ParameterException;

import io.furrow.files.Folders;
import io.furrow.flink.TestClusters;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.image.Pictures;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.topic.Topics;
import io.furrow.unchecked.Unchecked;

import static java.nio.charset.StandardCharsets.ISO_8859_1;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class DividedIngestTest {
    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(2);

    private static final long TIME = 1_700_000_000_000L;

    @TempDir
    Path folder;

    @Tag("full")
    @Test
    void writesWithAllItsPartsTogetherWhatTheWholeWrites() throws Exception {
        TopicRecord[] reported = reported();
        Path whole = folder.resolve("whole");
        Path divided = folder.resolve("parts");
        List<String> expected =
                told(IngestRun.of(options("--images", whole.toString()), FixedDevices.of(), reported), whole);

        List<TopicRecord> together = new ArrayList<>();
        for (String part : List.of("routes", "latest", "catalog", "images")) {
            IngestOptions options = options("--parts", part, "--images", divided.toString());
            together.addAll(IngestRun.of(options, FixedDevices.of(), reported));
        }

        assertThat(told(together, divided)).containsExactlyInAnyOrderElementsOf(expected);
        assertThat(files(divided)).containsExactlyInAnyOrderElementsOf(files(whole));
    }

    /** Images in two tenants, two of one entity in one millisecond, broken ones, deletions, repeats and garbage. */
    private static TopicRecord[] reported() {
        List<TopicRecord> records = new ArrayList<>();
        for (int i = 0; i < 40; i++) {
            records.add(record(
                    "t" + i,
                    i,
                    "north",
                    Entity.builder("thermometer-" + i % 4, "Thermometer")
                            .text("Domain", "farm")
                            .text("Mission", "m")
                            .integer("n", i)));
            records.add(camera("c" + i, i, i % 2 == 0 ? "north" : "", Pictures.png(i)));
        }
        records.add(records.get(0));
        records.add(camera("same-time", 4, "north", Pictures.png(77)));
        records.add(camera("broken", 50, "", new byte[] {1, 2, 3}));
        records.add(new TopicRecord("data.raw", 0, 7, TIME, utf8("g"), utf8("{no json"), new HashMap<>()));
        records.add(
                new TopicRecord("data.raw", 0, 8, TIME + 60, utf8("thermometer-1"), null, headers("gone", "north")));
        return records.toArray(TopicRecord[]::new);
    }

    @Test
    void refersInEveryPartToTheFileThatThePartOfImagesWrites() throws Exception {
        TopicRecord camera = camera("c", 0, "", Pictures.png(1));

        List<TopicRecord> written =
                IngestRun.of(options("--parts", "routes", "--images", folder.toString()), FixedDevices.of(), camera);
        assertThat(files(folder)).isEmpty();
        IngestRun.of(options("--parts", "images", "--images", folder.toString()), FixedDevices.of(), camera);

        String url = Entity.parse(written.get(0).value())
                .value("Image")
                .orElseThrow()
                .path("url")
                .textValue();
        assertThat(Path.of(java.net.URI.create(url))).hasBinaryContent(Pictures.png(1));
    }

    @Test
    void givesAPartANameOfItsOwn() {
        String mongo = "mongodb://127.0.0.1:1";

        assertThat(options().jobName()).isEqualTo("ingest");
        assertThat(options("--parts", "missions", "--mongo", mongo).jobName()).isEqualTo("ingest-missions");
        assertThat(options("--parts", "latest,routes").groupId()).isEqualTo("furrow-ingest-routes-latest");
        assertThat(options("--parts", "latest", "--name", "newest").jobName()).isEqualTo("newest");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
        --parts routes --name ingest | --name ingest is the name of all parts together
        --parts missions             | --parts missions has no server; add --mongo URI
        --parts images,routes        | --parts images has no folder; add --images URI
        """)
    void refusesAPartThatCannotBe(String arguments, String message) {
        IngestOptions options = options(arguments.split(" "));

        assertThatThrownBy(() -> IngestJob.assemble(options))
                .isInstanceOf(ParameterException.class)
                .hasMessageContaining(message);
    }

    private static IngestOptions options(String... arguments) {
        IngestOptions options = new IngestOptions();
        JobCommandLine.of(options).parseArgs(arguments);
        return options;
    }

    /**
     * What was written, less what differs by time or by the length of an image's name: the stamp of ingest, hashes in names, the
     * bytes in the catalog, of which the last entries count.
     */
    private static List<String> told(List<TopicRecord> written, Path images) {
        List<String> told = new ArrayList<>();
        Map<String, String> catalog = new LinkedHashMap<>();
        for (TopicRecord record : written) {
            Map<String, String> headers = new TreeMap<>(record.headers());
            headers.remove(HeaderNames.TS_INGEST);
            String key = new String(record.key(), UTF_8);
            String value = record.value() == null ? "" : new String(record.value(), UTF_8);
            String line = record.topic() + " " + key + " "
                    + value.replace(images.toString(), "").replaceAll("-[0-9a-f]{64}[.]", ".") + " " + headers;
            if (record.topic().equals(Topics.CATALOG)) {
                catalog.put(key, line.replaceAll("\"bytes\":[0-9]+", ""));
            } else {
                told.add(line + " " + record.timestamp());
            }
        }
        told.addAll(catalog.values());
        return told;
    }

    private static List<byte[]> contents(Stream<Path> files) {
        return files.map(file -> Unchecked.get(() -> Files.readAllBytes(file))).toList();
    }

    private static List<String> files(Path folder) throws Exception {
        if (!Files.exists(folder)) {
            return List.of();
        }
        return contents(Folders.walk(folder).stream().filter(Files::isRegularFile)).stream()
                .map(bytes -> new String(bytes, ISO_8859_1))
                .toList();
    }

    private static TopicRecord camera(String eventId, int time, String tenant, byte[] image) {
        return record(
                eventId,
                time,
                tenant,
                Entity.builder("camera", "Camera")
                        .text("Domain", "farm")
                        .text("Mission", "m")
                        .text("Image", java.util.Base64.getEncoder().encodeToString(image)));
    }

    private static TopicRecord record(String eventId, int time, String tenant, EntityBuilder entity) {
        Entity built = entity.build();
        return new TopicRecord(
                "data.raw", 0, 7, TIME + time, utf8(built.id()), built.toBytes(), headers(eventId, tenant));
    }

    private static Map<String, String> headers(String eventId, String tenant) {
        return new HashMap<>(Map.of(HeaderNames.CE_ID, eventId, HeaderNames.SERVICE, tenant));
    }

    private static byte[] utf8(String text) {
        return text.getBytes(UTF_8);
    }
}
