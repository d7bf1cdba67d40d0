package io.furrow.cli.command;

import java.io.ByteArrayOutputStream;
import java.io.InputStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.zip.GZIPInputStream;
import java.util.zip.GZIPOutputStream;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.cli.control.StubControl;

import static java.nio.charset.StandardCharsets.ISO_8859_1;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** The commands of stored missions, through a control plane. */
class RecordingCommandsTest {
    private static final String LINES = """
            {"id":"e1","time":1700000000000,"headers":{},"entity":{"id":"r1","type":"Robot","location":{"type":"geo:json","value":{"type":"Point","coordinates":[-3.48,40.31]},"metadata":{}}}}
            {"id":"e2","time":1700000001000,"headers":{},"entity":{"id":"r1","type":"Robot","location":{"type":"geo:point","value":"here","metadata":{}}}}
            """;
    private static final String EVENTS = "/api/recordings/hoeing/events";

    @AutoClose
    private final StubControl control = new StubControl()
            .answer("GET " + EVENTS, LINES)
            .answer(
                    "GET /api/missions/hoeing/markers",
                    "[{'id':'m1','mission':'hoeing','time':1700000000500,'note':'turns','author':'Ada','created':1700000009000}]");

    @TempDir
    private Path folder;

    @Test
    void listsStoredMissions() {
        control.answer(
                "GET /api/recordings",
                "[{'mission':'hoeing','first':1700000000000,'last':'2023-11-14T22:13:21Z','events':2}]");

        assertThat(control.run("mission", "stored")).isZero();

        assertThat(control.output())
                .containsPattern("MISSION +EVENTS +FIRST +LAST")
                .containsPattern("hoeing +2 +2023-11-14T22:13:20Z +2023-11-14T22:13:21Z");
    }

    @Test
    void listsNoMoreMissionsThanAreRequested() {
        control.answerPage("GET /api/recordings?limit=1", "[{'mission':'hoeing','events':2}]", "?limit=1&page=2");

        assertThat(control.run("mission", "stored", "--limit", "1")).isZero();

        assertThat(control.output().lines())
                .satisfiesExactly(
                        line -> assertThat(line).startsWith("MISSION"),
                        line -> assertThat(line).startsWith("hoeing"),
                        line -> assertThat(line).isEqualTo("There are more than 1; --limit shows more of them."));
        assertThat(control.run("mission", "stored", "--limit", "20001")).isEqualTo(2);
        assertThat(control.output()).contains("--limit is 1 to 20000, not 20001");
    }

    @Test
    void exportsAMissionInEachFormat() throws Exception {
        assertThat(Files.readString(exported("hoeing.jsonl"))).isEqualTo(LINES);
        assertThat(control.output())
                .isEqualToIgnoringNewLines(
                        "2 events of hoeing in %s/hoeing.jsonlits markers in %1$s/hoeing.markers.jsonl"
                                .formatted(folder));
        assertThat(Files.readString(folder.resolve("hoeing.markers.jsonl")))
                .startsWith("{\"id\":\"m1\",\"mission\":\"hoeing\",\"time\":1700000000500,");
        assertThat(Files.readString(exported("hoeing.geojson", "--format", "geojson", "-o", "json")))
                .contains("\"coordinates\":[-3.48,40.31]", "{\"kind\":\"marker\",\"id\":\"m1\"");
        assertThat(control.output()).contains("\"leftOut\" : 1", "\"events\" : 1");
        assertThat(new String(Files.readAllBytes(exported("hoeing.mcap", "--format", "mcap")), ISO_8859_1))
                .contains("\"note\":\"turns\"")
                .endsWith("MCAP0\r\n");
    }

    @Test
    void leavesNoFileOfAnExportThatIsRefused() {
        assertThat(control.run(
                        "mission",
                        "export",
                        "typo",
                        folder.resolve("typo.jsonl").toString()))
                .isEqualTo(1);

        assertThat(control.output()).isEqualToIgnoringNewLines("there is no GET /api/recordings/typo/events (unknown)");
        assertThat(folder).isEmptyDirectory();
    }

    @Test
    void rejectsAFileWithoutAName() {
        assertThat(control.run("mission", "export", "hoeing", "")).isEqualTo(2);

        assertThat(control.output()).contains("empty string. Check --mongo and the file's name.");
    }

    @Test
    void addsWhatIsMissingToAnArchive() throws Exception {
        control.answer("GET /api/recordings", "[{'mission':'hoeing'},{'mission':'_x-68'}]")
                .answer("GET /api/recordings/_x-68/events", LINES);

        assertThat(control.run("mission", "archive", folder.toString(), "hoeing", "_x-68"))
                .isZero();
        assertThat(control.run("mission", "archive", folder.toString(), "hoeing"))
                .isZero();

        assertThat(control.output())
                .contains("hoeing: 2 events added in 1 file, 0 there before, in " + folder + "/mission_hoeing\n")
                .contains("_x-68: 2 events added in 1 file, 0 there before, in " + folder + "/mission__x-68\n")
                .contains("hoeing: 0 events added in 0 files, 2 there before, in ");
        try (InputStream day =
                new GZIPInputStream(Files.newInputStream(folder.resolve("mission_hoeing/2023-11-14-0001.ndjson.gz")))) {
            assertThat(day).hasContent(LINES);
        }
        assertThat(control.run("mission", "archive", folder.toString(), "typo")).isEqualTo(1);
        assertThat(control.output()).isEqualToIgnoringNewLines("there is no GET /api/recordings/typo/events (unknown)");
    }

    @Test
    void importsAFileThatIsCompressed() throws Exception {
        control.answer("POST " + EVENTS, "{'status':'imported','mission':'hoeing','events':2}");
        ByteArrayOutputStream bytes = new ByteArrayOutputStream();
        try (GZIPOutputStream out = new GZIPOutputStream(bytes)) {
            out.write(LINES.getBytes(UTF_8));
        }
        Path file = Files.write(folder.resolve("hoeing.jsonl.gz"), bytes.toByteArray());

        assertThat(control.run("mission", "import", "hoeing", file.toString())).isZero();

        assertThat(control.output()).isEqualToIgnoringNewLines("2 events of %s now in mission hoeing".formatted(file));
        assertThat(control.requested()).containsExactly("POST " + EVENTS + " " + LINES.strip());
        Files.write(file, new byte[] {0x1f, (byte) 0x8b, 8, 0, 0, 0, 0, 0, 0, 0, 7});
        assertThat(control.run("mission", "import", "hoeing", file.toString())).isEqualTo(1);
        assertThat(control.output()).startsWith("cannot read or write: ");
    }

    private Path exported(String name, String... options) {
        Path file = folder.resolve(name);
        String[] command = {"mission", "export", "hoeing", file.toString()};
        assertThat(control.run(java.util.stream.Stream.of(command, options)
                        .flatMap(java.util.stream.Stream::of)
                        .toArray(String[]::new)))
                .isZero();
        return file;
    }
}
