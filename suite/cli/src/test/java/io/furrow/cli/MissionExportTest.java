package io.furrow.cli;

import java.io.ByteArrayInputStream;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;

import io.furrow.embedded.EmbeddedMongo;
import io.furrow.mission.archive.StoredMissions;
import io.furrow.mission.marker.Marker;
import io.furrow.mission.marker.Markers;
import io.furrow.mission.mongo.MongoAccess;

import static java.nio.charset.StandardCharsets.ISO_8859_1;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class MissionExportTest {
    private static final String LINES = """
            {"id":"e1","time":1700000000000,"headers":{},"entity":{"id":"r1","type":"Robot","location":{"type":"geo:json","value":{"type":"Point","coordinates":[-3.48,40.31]},"metadata":{}}}}
            {"id":"e2","time":1700000001000,"headers":{},"entity":{"id":"r1","type":"Robot","location":{"type":"geo:point","value":"here","metadata":{}}}}
            """;

    @TempDir
    Path folder;

    private final StringWriter out = new StringWriter();
    private final CommandLine furrow = Commands.commandLine(CommandSpec.create().name("furrow"), Commands.ALL)
            .setOut(new PrintWriter(out));

    @Test
    void writesAMissionInEachFormat() throws Exception {
        try (EmbeddedMongo mongo = EmbeddedMongo.inMemory()) {
            try (StoredMissions missions = StoredMissions.open(mongo.uri())) {
                byte[] lines = LINES.getBytes(UTF_8);
                missions.importFrom("hoeing", new ByteArrayInputStream(lines), "lines", told -> {});
            }

            assertThat(Files.readString(exported(mongo, "hoeing.ndjson"))).isEqualTo(LINES);
            assertThat(folder.resolve("hoeing.markers.jsonl")).doesNotExist();
            assertThat(Files.readAllBytes(exported(mongo, "hoeing.mcap", "--format", "mcap")))
                    .startsWith(0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n')
                    .endsWith(0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n');
            assertThat(Files.readString(exported(mongo, "hoeing.geojson", "--format", "geojson")))
                    .contains("\"geometry\":{\"type\":\"Point\",\"coordinates\":[-3.48,40.31]}");
            assertThat(out.toString())
                    .contains("2 events of hoeing in " + folder.resolve("hoeing.mcap"))
                    .contains("1 event of hoeing in " + folder.resolve("hoeing.geojson"))
                    .contains("1 left out, the first: event e2: geo:point is not 'lat, lon'");
        }
    }

    @Test
    void writesTheMarkersOfAMissionInEachFormat() throws Exception {
        try (EmbeddedMongo mongo = EmbeddedMongo.inMemory();
                Markers markers = Markers.open(mongo.uri(), MongoAccess.DATABASE)) {
            try (StoredMissions missions = StoredMissions.open(mongo.uri())) {
                byte[] lines = LINES.getBytes(UTF_8);
                missions.importFrom("hoeing", new ByteArrayInputStream(lines), "lines", told -> {});
            }
            markers.add(new Marker("m1", "hoeing", 1_700_000_000_500L, "turns", "Ada", 1_700_000_009_000L));

            assertThat(Files.readString(exported(mongo, "hoeing.ndjson.gz").resolveSibling("hoeing.markers.jsonl")))
                    .startsWith("{\"id\":\"m1\",\"mission\":\"hoeing\",\"time\":1700000000500,")
                    .endsWith("}\n");
            assertThat(out.toString()).contains("its markers in " + folder.resolve("hoeing.markers.jsonl"));
            assertThat(Files.readString(exported(mongo, "hoeing.geojson", "--format", "geojson")))
                    .contains("{\"kind\":\"marker\",\"id\":\"m1\"");
            assertThat(new String(Files.readAllBytes(exported(mongo, "hoeing.mcap", "--format", "mcap")), ISO_8859_1))
                    .contains("\"note\":\"turns\"");

            markers.remove("hoeing", "m1");
            assertThat(exported(mongo, "hoeing.jsonl").resolveSibling("hoeing.markers.jsonl"))
                    .isEmptyFile();
        }
    }

    private Path exported(EmbeddedMongo mongo, String name, String... options) {
        Path file = folder.resolve(name);
        String[] arguments = {"mission", "export", "--mongo", mongo.uri(), "hoeing", file.toString()};
        String[] all = java.util.stream.Stream.concat(
                        java.util.Arrays.stream(arguments), java.util.Arrays.stream(options))
                .toArray(String[]::new);
        assertThat(furrow.execute(all)).isZero();
        return file;
    }
}
