package io.furrow.mission.export;

import java.io.ByteArrayOutputStream;
import java.nio.charset.StandardCharsets;
import java.util.Optional;

import org.junit.jupiter.api.Test;

import io.furrow.mission.FileRecordings;
import io.furrow.mission.Recording;

import static org.assertj.core.api.Assertions.assertThat;

class GeoJsonExportTest {
    @Test
    void drawsATrackOfWhatMovedAndAPointForWhatStoodStill() throws Exception {
        ByteArrayOutputStream out = new ByteArrayOutputStream();
        try (Recording recording = new FileRecordings("src/test/resources/export/mission.ndjson")
                .open("hoeing")
                .orElseThrow()) {
            assertThat(new GeoJsonExport().write("hoeing", recording, out, ignored -> {}))
                    .isEqualTo(
                            new Exported(9, 1, Optional.of("event e06: 0,0 is what a receiver without a fix reports")));
        }

        assertThat(out.toString(StandardCharsets.UTF_8)).isEqualTo("""
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
}
