package io.furrow.ingest;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Base64;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Stream;

import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine.ParameterException;

import io.furrow.files.Folders;
import io.furrow.files.RandomPicture;
import io.furrow.flink.TestClusters;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** Images within the whole job. */
class ImageStageJobTest {
    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(2);

    private static final long TIME = 1_700_000_000_000L;

    @Test
    void sendsAReferenceToDomainAndMissionAndAManifest(@TempDir Path folder) throws Exception {
        byte[] image = RandomPicture.of("png", 1);
        TopicRecord camera = camera("c1", 0, image);

        List<TopicRecord> written = run(options("--images", folder.toString()), camera);

        assertThat(written)
                .extracting(TopicRecord::topic)
                .containsExactlyInAnyOrder("data.farm.realtime", "data.farm.realtime.m", "data.images");
        String manifest = value(written, "data.images");
        String url = NgsiJson.read(manifest.getBytes(UTF_8)).path("url").textValue();
        assertThat(Path.of(java.net.URI.create(url))).hasBinaryContent(image);
        for (String topic : List.of("data.farm.realtime", "data.farm.realtime.m")) {
            Entity entity = Entity.parse(value(written, topic).getBytes(UTF_8));
            assertThat(entity.value("Image").orElseThrow().path("url").textValue())
                    .isEqualTo(url);
            assertThat(entity.text("Domain")).hasValue("farm");
        }
    }

    @Test
    void leavesImagesInTheEventsWithoutAFolder() throws Exception {
        TopicRecord camera = camera("c1", 0, RandomPicture.of("png", 1));

        List<TopicRecord> written = run(options(), camera);

        assertThat(written)
                .hasSize(2)
                .allSatisfy(record -> assertThat(record.value()).isEqualTo(camera.value()));
    }

    @Tag("full")
    @Test
    void storesEveryImageOfManyCameras(@TempDir Path folder) throws Exception {
        List<TopicRecord> records = new ArrayList<>();
        byte[] image = RandomPicture.of("png", 1);
        for (int i = 0; i < 500; i++) {
            records.add(camera("c" + i % 20, i, i % 50 == 7 ? new byte[] {1, 2, 3} : image));
        }

        List<TopicRecord> written = run(options("--images", folder.toString()), records.toArray(TopicRecord[]::new));

        assertThat(written)
                .filteredOn(record -> record.topic().equals("data.images"))
                .hasSize(490);
        assertThat(written)
                .filteredOn(record -> record.topic().equals("data.raw.dead"))
                .hasSize(10);
        Map<String, Long> last = new HashMap<>();
        Set<String> events = new HashSet<>();
        written.stream()
                .filter(record -> record.topic().equals("data.farm.realtime"))
                .forEach(record -> {
                    assertThat(events.add(record.headers().get(HeaderNames.CE_ID)))
                            .isTrue();
                    String key = new String(record.key(), UTF_8);
                    assertThat(record.timestamp()).isGreaterThan(last.getOrDefault(key, -1L));
                    last.put(key, record.timestamp());
                });
        assertThat(events).hasSize(500);
        assertThat(Folders.walk(folder).stream().filter(Files::isRegularFile))
                .hasSize(490)
                .allSatisfy(file -> assertThat(file).hasBinaryContent(image));
    }

    @Test
    void keepsACatalogueOfWhatPassed(@TempDir Path folder) throws Exception {
        List<TopicRecord> records = new ArrayList<>();
        byte[] image = RandomPicture.of("png", 1);
        for (int i = 0; i < 60; i++) {
            records.add(camera("c" + i % 20, i * 1_000, image));
        }

        IngestOptions options = new IngestOptions();
        JobCommandLine.of(options).parseArgs("--images", folder.toString(), "--no-latest", "--catalog-interval", "5s");
        List<TopicRecord> written = run(options, records.toArray(TopicRecord[]::new));

        List<TopicRecord> catalog = written.stream()
                .filter(record -> record.topic().equals("data.catalog"))
                .toList();
        var last = NgsiJson.read(catalog.get(catalog.size() - 1).value());
        assertThat(last.path("entities").asInt()).isEqualTo(20);
        assertThat(last.path("events").asInt()).isEqualTo(60);
        assertThat(last.path("images").asInt()).isEqualTo(60);
        assertThat(last.path("imageBytes").asInt()).isEqualTo(60 * image.length);
        assertThat(last.at("/attributes/Image/kind").textValue()).isEqualTo("image");
    }

    @Test
    void refusesToStartWhereFlinkHasNoFileSystem() {
        IngestOptions options = options("--images", "nowhere://x/y");

        assertThatThrownBy(() -> IngestJob.assemble(options))
                .isInstanceOf(ParameterException.class)
                .hasMessageContaining("--images nowhere://x/y: Flink has no file system for it here");
    }

    private static String value(List<TopicRecord> written, String topic) {
        return written.stream()
                .filter(record -> record.topic().equals(topic))
                .map(record -> new String(record.value(), UTF_8))
                .findFirst()
                .orElseThrow();
    }

    private static List<TopicRecord> run(IngestOptions options, TopicRecord... records) throws Exception {
        return IngestRun.of(options, FixedDevices.of(), records);
    }

    private static IngestOptions options(String... args) {
        IngestOptions options = new IngestOptions();
        JobCommandLine.of(options)
                .parseArgs(Stream.concat(Stream.of("--no-latest", "--no-catalog"), Stream.of(args))
                        .toArray(String[]::new));
        return options;
    }

    private static TopicRecord camera(String id, int i, byte[] image) {
        Entity entity = Entity.builder(id, "Camera")
                .text("Domain", "farm")
                .text("Mission", "m")
                .text("Image", Base64.getEncoder().encodeToString(image))
                .build();
        return new TopicRecord(
                "data.raw",
                0,
                i,
                TIME + i,
                id.getBytes(UTF_8),
                entity.toBytes(),
                new HashMap<>(Map.of(HeaderNames.CE_ID, "e" + i)));
    }
}
