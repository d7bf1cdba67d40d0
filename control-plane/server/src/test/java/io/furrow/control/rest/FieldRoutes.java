package io.furrow.control.rest;

import java.time.Instant;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Tests {@code /api/fields}. */
interface FieldRoutes extends RestApiRoutes {
    @Test
    default void importsFieldsAndRejectsInvalidOnes() throws Exception {
        String square = "[[[10,50],[10.001,50],[10.001,50.001],[10,50.001],[10,50]]]";
        String file = """
                {"type":"FeatureCollection","features":[
                  {"type":"Feature","id":"a","geometry":{"type":"Polygon","coordinates":%s},"properties":{"name":"Home"}},
                  {"type":"Feature","id":"b","geometry":{"type":"Point","coordinates":[10,50]},"properties":{}}]}
                """.formatted(square);

        JsonNode first = client().ask("POST", "/api/fields?domain=north", file);
        JsonNode repeated = client().ask("POST", "/api/fields?domain=north", file);

        assertThat(first.path("imported").asInt()).isEqualTo(1);
        assertThat(first.at("/fields/0/change").asText()).isEqualTo("added");
        assertThat(first.at("/refused/0/id").asText()).isEqualTo("b");
        assertThat(first.at("/refused/0/reason").asText()).contains("Point");
        assertThat(repeated.path("imported").asInt()).isZero();
        assertThat(repeated.path("unchanged").asInt()).isEqualTo(1);
        JsonNode fields = running().get("/api/fields");
        assertThat(fields.path("type").asText()).isEqualTo("FeatureCollection");
        assertThat(fields.path("features")).hasSize(1);
        JsonNode home = fields.at("/features/0");
        assertThat(home.path("id").asText()).isEqualTo("a");
        assertThat(home.at("/properties/name").asText()).isEqualTo("Home");
        assertThat(home.at("/geometry/coordinates/0/1/0").asDouble()).isEqualTo(10.001);
        assertThat(running().get("/api/fields?domain=north").path("features")).hasSize(1);
        assertThat(running().get("/api/fields?domain=south").path("features")).isEmpty();
        client().send("POST", "/api/fields?domain=north", file.replace("Home", "Behind the barn"));
        assertThat(running().get("/api/fields").path("features"))
                .singleElement()
                .satisfies(
                        now -> assertThat(now.at("/properties/name").asText()).isEqualTo("Behind the barn"));

        String bow = file.replace(square, "[[[10,50],[10.002,50.002],[10.002,50],[10,50.002],[10,50]]]");
        assertThat(client().ask("POST", "/api/fields?domain=north", bow).at("/fields/0/mended"))
                .anySatisfy(note -> assertThat(note.asText()).contains("Self-intersection"));
        assertThat(running().get("/api/fields").at("/features/0/geometry/type").asText())
                .isEqualTo("MultiPolygon");
        assertThat(client().ask("POST", "/api/fields?crs=EPSG:1", file)
                        .path("reason")
                        .asText())
                .contains("specify it with 'crs'");
        assertThat(client().ask("POST", "/api/fields?name-property=nosuch", file)
                        .path("reason")
                        .asText())
                .contains("'name-property' nosuch: no feature of the file has this attribute");

        client().send("POST", "/api/fields?domain=paged", file.replace("\"a\"", "\"p1\""));
        client().send("POST", "/api/fields?domain=paged", file.replace("\"a\"", "\"p2\""));
        var page = client().send("GET", "/api/fields?domain=paged&limit=1", null);
        assertThat(client().json(page).path("type").asText()).isEqualTo("FeatureCollection");
        assertThat(client().json(page).at("/features/0/id").asText()).isEqualTo("p1");
        assertThat(page.headers().firstValue("Link")).contains("<?domain=paged&limit=1&page=2>; rel=\"next\"");
        assertThat(running()
                        .get("/api/fields?domain=paged&limit=1&page=2")
                        .at("/features/0/id")
                        .asText())
                .isEqualTo("p2");
        assertThat(client().status("DELETE", "/api/fields/p1", null)).isEqualTo(200);
        assertThat(client().status("DELETE", "/api/fields/p2", null)).isEqualTo(200);

        JsonNode renamed = client().ask("PATCH", "/api/fields/a", "{\"field\":\"a\",\"name\":\"Hill\"}");
        assertThat(renamed.path("status").asText() + " " + renamed.path("name").asText())
                .isEqualTo("changed Hill");
        assertThat(running()
                        .get("/api/fields")
                        .at("/features/0/properties/name")
                        .asText())
                .isEqualTo("Hill");
        for (String body : new String[] {
            "{}",
            "{\"name\":\" \"}",
            "{\"name\":\"x\",\"validTo\":1}",
            "{\"validTo\":\"soon\"}",
            "{\"validTo\":null}",
            "{\"name\":7}"
        }) {
            running().rejects("PATCH", "/api/fields/a", body, 400, "wrong-member");
        }
        running().rejects("PATCH", "/api/fields/a", "{\"nmae\":\"x\"}", 400, "unknown-member");
        running().rejects("PATCH", "/api/fields/z", "{\"name\":\"x\"}", 404, "unknown-field");
        running().rejects("DELETE", "/api/fields/z", null, 404, "unknown-field");
        running().rejects("PATCH", "/api/fields/a", "{\"validTo\":1}", 409, "wrong-state");
        String now = Instant.now().toString();
        assertThat(client().ask("PATCH", "/api/fields/a", "{\"validTo\":\"%s\"}".formatted(now))
                        .path("status")
                        .asText())
                .isEqualTo("ended");
        assertThat(running().get("/api/fields").path("features")).isEmpty();
        assertThat(client().ask("DELETE", "/api/fields/a", null)
                        .path("versions")
                        .asInt())
                .isEqualTo(4);

        running().rejects("POST", "/api/fields", "{\"type\":\"Feature", 400, "unusable-file");
        running().rejects("POST", "/api/fields?domain=a.b", file, 400, "wrong-member");
        running().rejects("POST", "/api/fields", " ".repeat(FieldsResource.MAX_BYTES + 1), 413, "too-large");
        await().untilAsserted(
                        () -> assertThat(running().get("/api/audit?limit=1000").findValuesAsText("command"))
                                .contains("import-fields", "rename-field", "end-field", "delete-field"));
    }

    @Test
    default void replacesFieldsAtATimeOrShowsWhatThatWouldChange() throws Exception {
        String feature =
                "{\"type\":\"Feature\",\"id\":\"%s\",\"geometry\":{\"type\":\"%s\",\"coordinates\":[[[20,50],[20.001,50],[20.001,50.001],[20,50]]]},\"properties\":{}}";
        String spring = "/api/fields?domain=%s&validFrom=2026-03-01T00:00:00Z";
        client().ask("POST", spring.formatted("west"), feature.formatted("w1", "Polygon"));
        client().ask("POST", spring.formatted("east"), feature.formatted("e1", "Polygon"));

        String replacing = "/api/fields?domain=west&replace=true&validFrom=2026-04-01T00:00:00Z";
        JsonNode dryRun = client().ask("POST", replacing + "&dryRun=true", feature.formatted("w2", "Polygon"));
        assertThat(dryRun.path("dryRun").asBoolean()).isTrue();
        assertThat(dryRun.path("ended").asInt()).isEqualTo(1);
        assertThat(dryRun.path("fields").findValuesAsText("change")).containsExactly("added", "ended");
        assertThat(ids("domain=west")).containsExactly("w1");
        running().rejects("POST", replacing, feature.formatted("w2", "Point"), 400, "refused-features");
        assertThat(ids("domain=west")).containsExactly("w1");

        client().ask("POST", replacing, feature.formatted("w2", "Polygon"));
        assertThat(ids("domain=west")).containsExactly("w2");
        assertThat(ids("domain=west&at=2026-03-31T23:59:59Z")).containsExactly("w1");
        assertThat(ids("at=2026-02-01T00:00:00Z")).isEmpty();
        assertThat(ids("versions=true")).contains("e1", "w1", "w1", "w2");
        JsonNode moved = client().ask("POST", "/api/fields?domain=west", feature.formatted("e1", "Polygon"));
        assertThat(moved.at("/fields/0/domainBefore").asText()).isEqualTo("east");
        running().rejects("POST", "/api/fields?replace=maybe", "{}", 400, "wrong-member");
        running().rejects("POST", "/api/fields?validFrom=spring", "{}", 400, "wrong-member");
        for (String id : List.of("w1", "w2", "e1")) {
            assertThat(client().status("DELETE", "/api/fields/" + id, null)).isEqualTo(200);
        }
    }

    private List<String> ids(String query) throws Exception {
        return running().get("/api/fields?" + query).path("features").findValuesAsText("id");
    }
}
