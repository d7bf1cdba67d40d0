package io.furrow.cli.catalog;

import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class CatalogTableTest {
    @Test
    void showsAMissionsTypeAndItsAttributesBelowEachOther() throws Exception {
        String entry = """
                {"service": "farm", "domain": "north", "mission": "weeding", "type": "Thermometer", "entities": 3,
                 "events": 1200, "bytes": 1234567, "images": 0, "imageBytes": 0, "first": "2023-11-14T22:13:20Z",
                 "last": "2023-11-14T23:13:20.250Z", "rate": 0.333, "attributes": {"Temperature": {"type": "Float",
                 "unit": "CEL", "kind": "number", "values": 1200, "min": -3.5, "max": 31.0,
                 "first": "2023-11-14T22:13:20Z", "last": "2023-11-14T23:13:20Z", "rate": 0.333}}}
                """;

        List<String> lines = CatalogTable.lines(List.of(NgsiJson.read(entry.getBytes(UTF_8))));

        assertThat(lines).hasSize(4);
        assertThat(lines.get(2).split(" {2,}"))
                .containsExactly(
                        "north / weeding",
                        "Thermometer",
                        "3",
                        "1200",
                        "1.2 MB",
                        "0",
                        "0 B",
                        "2023-11-14T22:13:20Z",
                        "2023-11-14T23:13:20Z");
        assertThat(lines.get(3).trim().split(" {2,}"))
                .containsExactly(
                        "Temperature",
                        "Float, number",
                        "CEL",
                        "1200",
                        "0.333",
                        "-3.5 … 31.0",
                        "2023-11-14T22:13:20Z",
                        "2023-11-14T23:13:20Z");
    }

    @Test
    void makesRoomForLongNames() throws Exception {
        String entry = """
                {"domain": "%s", "mission": "weeding", "type": "Thermometer", "attributes": {"%s": {"unit": "CEL"}}}""";
        String name = "a".repeat(40);

        List<String> lines = CatalogTable.lines(List.of(
                NgsiJson.read(entry.formatted(name, name).getBytes(UTF_8)),
                NgsiJson.read(entry.formatted("b", "b").getBytes(UTF_8))));

        assertThat(lines).hasSize(6);
        assertThat(List.of(lines.get(0).indexOf("TYPE"), lines.get(4).indexOf("Thermometer")))
                .containsOnly(lines.get(2).indexOf("Thermometer"));
        assertThat(List.of(lines.get(1).indexOf("unit"), lines.get(5).indexOf("CEL")))
                .containsOnly(lines.get(3).indexOf("CEL"));
    }

    @Test
    void showsTypesWithoutAttributes() throws Exception {
        JsonNode entry = NgsiJson.read("{\"domain\": \"north\", \"type\": \"Camera\"}".getBytes(UTF_8));

        assertThat(CatalogTable.lines(List.of(entry)))
                .satisfiesExactly(
                        line -> assertThat(line).startsWith("DOMAIN / MISSION"),
                        line -> assertThat(line).startsWith("north / -         Camera"));
    }

    @Test
    void reportsThatNothingIsStored() {
        assertThat(CatalogTable.lines(List.of())).containsExactly("Nothing is stored yet.");
    }

    @ParameterizedTest
    @CsvSource({"0, 0 B", "999, 999 B", "1000, 1.0 kB", "1234567, 1.2 MB", "5000000000000000, 5000.0 TB"})
    void writesSizesForPeople(long bytes, String size) {
        assertThat(CatalogTable.size(bytes)).isEqualTo(size);
    }
}
