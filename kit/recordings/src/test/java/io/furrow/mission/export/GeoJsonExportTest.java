package io.furrow.mission.export;

import java.io.ByteArrayOutputStream;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Optional;

import com.fasterxml.jackson.core.JsonFactory;
import com.fasterxml.jackson.core.JsonGenerator;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.mission.Recording;
import io.furrow.mission.file.FileRecordings;
import io.furrow.mission.marker.Marker;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.position.Position;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class GeoJsonExportTest {
    @Test
    void writesALineForMovingEntitiesAndAPointForOthers() throws Exception {
        ByteArrayOutputStream out = new ByteArrayOutputStream();
        try (Recording recording = new FileRecordings("src/test/resources/export/mission.ndjson")
                .open("hoeing")
                .orElseThrow()) {
            assertThat(new GeoJsonExport()
                            .write(new MissionExport.Source("hoeing", recording, List.of()), out, ignored -> {}))
                    .isEqualTo(new ExportResult(
                            9, 1, Optional.of("event e06: 0,0 is what a receiver without a fix reports")));
        }

        assertThat(out.toString(UTF_8)).isEqualTo("""
                {"type":"FeatureCollection","features":[\
                {"type":"Feature","geometry":{"type":"LineString",\
                "coordinates":[[-3.4832,40.3138],[-3.4832,40.3138],[-3.4831,40.3139]]},\
                "properties":{"id":"urn:ngsi-ld:Robot:1","type":"Robot","mission":"hoeing","service":"farm",\
                "servicePath":"/","positions":4,"first":"2023-11-14T22:13:20Z","last":"2023-11-14T22:13:23Z",\
                "times":["2023-11-14T22:13:20Z","2023-11-14T22:13:22Z","2023-11-14T22:13:23Z"]}},\
                {"type":"Feature","geometry":{"type":"Point","coordinates":[-3.48,40.31]},\
                "properties":{"id":"urn:ngsi-ld:Thermometer:1","type":"Thermometer","mission":"hoeing",\
                "service":"farm","servicePath":"/","positions":2,"first":"2023-11-14T22:13:20Z",\
                "last":"2023-11-14T22:13:24Z"}}]}""");
    }

    @Test
    void cutsATrackWhereItCrossesTheAntimeridian() throws Exception {
        Track track = new Track("r", FiwareScope.of("farm", "/"));
        track.add(0, new Position(10, 179), "Robot");
        track.add(4_000, new Position(14, -177), "Robot");
        track.add(8_000, new Position(14, -178), "Robot");
        track.add(9_000, new Position(14, 180), "Robot");
        StringWriter out = new StringWriter();
        try (JsonGenerator json = new JsonFactory().createGenerator(out)) {
            track.write("m", json);
        }

        assertThat(out.toString())
                .contains(
                        "\"type\":\"MultiLineString\"",
                        "\"coordinates\":[[[179.0,10.0],[180.0,11.0]],"
                                + "[[-180.0,11.0],[-177.0,14.0],[-178.0,14.0],[-180.0,14.0]],[[180.0,14.0],[180.0,14.0]]]",
                        "\"positions\":4",
                        "\"times\":[[\"1970-01-01T00:00:00Z\",\"1970-01-01T00:00:01Z\"],"
                                + "[\"1970-01-01T00:00:01Z\",\"1970-01-01T00:00:04Z\",\"1970-01-01T00:00:08Z\","
                                + "\"1970-01-01T00:00:09Z\"],[\"1970-01-01T00:00:09Z\",\"1970-01-01T00:00:09Z\"]]");
    }

    @Test
    void writesMarkersAsFeaturesWithoutGeometry(@TempDir Path folder) throws Exception {
        ByteArrayOutputStream out = new ByteArrayOutputStream();
        Path events = folder.resolve("hoeing.ndjson");
        Files.write(events, List.of());
        Marker marker = new Marker("a", "hoeing", 1_700_000_000_000L, "turns", "Ada", 1_700_000_000_001L);
        try (Recording recording =
                new FileRecordings(events.toString()).open("hoeing").orElseThrow()) {
            new GeoJsonExport()
                    .write(new MissionExport.Source("hoeing", recording, List.of(marker)), out, ignored -> {});
        }

        assertThat(out.toString(UTF_8)).isEqualTo("""
                {"type":"FeatureCollection","features":[{"type":"Feature","geometry":null,\
                "properties":{"kind":"marker","id":"a","mission":"hoeing","time":"2023-11-14T22:13:20Z",\
                "note":"turns","author":"Ada","created":"2023-11-14T22:13:20.001Z"}}]}""");
    }
}
