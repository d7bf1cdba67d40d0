package io.furrow.mission.export;

import java.io.ByteArrayOutputStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.util.List;
import java.util.Optional;
import java.util.stream.IntStream;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.mission.Recording;
import io.furrow.mission.file.FileRecordings;
import io.furrow.mission.marker.Marker;

import static org.assertj.core.api.Assertions.assertThat;

class McapExportTest {
    private static final Path RESOURCES = Path.of("src/test/resources/export");

    @TempDir
    Path folder;

    /** mcap 1.6.0 of PyPI has verified the expected file and its checksums; {@code ./furrow soak mcap} repeats that. */
    @Test
    void writesTheBytesThatAnIndependentReaderVerified() throws Exception {
        byte[] written = exported(RESOURCES.resolve("mission.ndjson"), new ExportResult(10, 0, Optional.empty()));

        assertThat(written).isEqualTo(Files.readAllBytes(RESOURCES.resolve("mission.mcap")));
    }

    @Test
    void givesEachEntityAChannelAndEachTypeASchema() throws Exception {
        McapFile file =
                new McapFile(exported(RESOURCES.resolve("mission.ndjson"), new ExportResult(10, 0, Optional.empty())));

        assertThat(file.channels.values())
                .extracting(McapFile.Channel::topic)
                .containsExactly(
                        "Robot/urn:ngsi-ld:Robot:1",
                        "Thermometer/urn:ngsi-ld:Thermometer:1",
                        "Robot/urn:ngsi-ld:Robot:1",
                        "Gate/Gate äöü",
                        "Thing/never seen");
        assertThat(file.channels.get(3).metadata())
                .containsEntry("fiware-service", "field")
                .containsEntry("mission", "hoeing")
                .containsEntry("entity", "urn:ngsi-ld:Robot:1");
        assertThat(file.schemas).hasSize(4);
        assertThat(file.schemas.get(2)).startsWith("Thermometer jsonschema {");
        assertThat(file.messages.get(8))
                .isEqualTo(new McapFile.Message(
                        "Gate/Gate äöü", 1_700_000_006_000_000_000L, "{\"id\":\"Gate äöü\",\"deleted\":true}"));
        assertThat(file.messages.get(1).data()).contains("\"value\":21.50");
    }

    @Test
    void indexesAMissionOfManyChunks() throws Exception {
        List<String> lines = IntStream.range(0, 9_000)
                .mapToObj(i ->
                        "{\"id\":\"e%05d\",\"time\":%d,\"headers\":{},\"entity\":{\"id\":\"t%d\",\"type\":\"T\",\"n\":{\"value\":\"%s\"}}}"
                                .formatted(i, 1_000 + i / 7, i % 11, "x".repeat(i % 700)))
                .toList();
        Path mission = folder.resolve("mission.ndjson");
        Files.write(mission, lines);

        McapFile file = new McapFile(exported(mission, new ExportResult(9_000, 0, Optional.empty())));

        assertThat(file.chunks).isGreaterThan(3);
        assertThat(file.messages).hasSize(9_000);
        assertThat(file.channels).hasSize(11);
    }

    @Test
    void writesAMissionWithoutEventsAndSkipsTimesThatMcapDoesNotHave() throws Exception {
        Path mission = folder.resolve("mission.ndjson");
        Files.write(mission, List.of());
        assertThat(new McapFile(exported(mission, new ExportResult(0, 0, Optional.empty()))).messages)
                .isEmpty();

        String line = "{\"id\":\"e\",\"time\":%d,\"headers\":{},\"entity\":{\"id\":\"t\"}}";
        Files.write(
                mission, List.of(line.formatted(-1), line.formatted(18_446_744_073_709L), line.formatted(1L << 53)));
        ExportResult two = new ExportResult(1, 2, Optional.of("event e: MCAP has no times before 1970 or after 2554"));
        assertThat(new McapFile(exported(mission, two)).messages)
                .extracting(McapFile.Message::nanos)
                .containsExactly(18_446_744_073_709L * 1_000_000);
    }

    @Test
    void writesMarkersAtTheirTimesOnAChannel() throws Exception {
        Path mission = folder.resolve("mission.ndjson");
        Files.writeString(mission, "{\"id\":\"e\",\"time\":7,\"headers\":{},\"entity\":{\"id\":\"t\",\"type\":\"T\"}}");
        List<Marker> markers = List.of(
                new Marker("a", "hoeing", 6, "turns", "Ada", 9),
                new Marker("b", "hoeing", 8, "stops", "", 9),
                new Marker("c", "hoeing", 1L << 46, "is over", "", 9));

        McapFile file = new McapFile(exported(
                mission,
                markers,
                new ExportResult(1, 1, Optional.of("a marker: MCAP has no times before 1970 or after 2554"))));

        assertThat(file.messages)
                .containsExactly(
                        new McapFile.Message(
                                "markers",
                                6_000_000,
                                "{\"id\":\"a\",\"mission\":\"hoeing\",\"time\":6,\"note\":\"turns\",\"author\":\"Ada\",\"created\":9}"),
                        new McapFile.Message("T/t", 7_000_000, "{\"id\":\"t\",\"type\":\"T\"}"),
                        new McapFile.Message(
                                "markers",
                                8_000_000,
                                "{\"id\":\"b\",\"mission\":\"hoeing\",\"time\":8,\"note\":\"stops\",\"author\":\"\",\"created\":9}"));
        assertThat(file.schemas.get(1))
                .startsWith("furrow.Marker jsonschema {")
                .contains("\"note\":{\"type\":\"string\"}");
    }

    private static byte[] exported(Path lines, ExportResult expected) throws Exception {
        return exported(lines, List.of(), expected);
    }

    private static byte[] exported(Path lines, List<Marker> markers, ExportResult expected) throws Exception {
        ByteArrayOutputStream out = new ByteArrayOutputStream();
        try (Recording recording =
                new FileRecordings(lines.toString()).open("hoeing").orElseThrow()) {
            MissionExport.Source mission = new MissionExport.Source("hoeing", recording, markers);
            assertThat(new McapExport().write(mission, out, ignored -> {})).isEqualTo(expected);
        }
        String target = System.getProperty("furrow.mcap.folder");
        if (target != null && markers.isEmpty()) { // for ./furrow soak mcap, which compares events
            Path copy = Files.createTempFile(Path.of(target), "mission", ".ndjson");
            Files.copy(lines, copy, StandardCopyOption.REPLACE_EXISTING);
            Files.write(Path.of(copy.toString().replace(".ndjson", ".mcap")), out.toByteArray());
        }
        return out.toByteArray();
    }
}
