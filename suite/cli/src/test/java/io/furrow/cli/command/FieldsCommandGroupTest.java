package io.furrow.cli.command;

import java.nio.file.Files;
import java.nio.file.Path;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.cli.control.StubControl;

import static org.assertj.core.api.Assertions.assertThat;

/** What the commands of fields send to a control plane, and what they print of its answers. */
class FieldsCommandGroupTest {
    private static final String FILE = """
            {"type":"FeatureCollection","features":[
              {"type":"Feature","id":"a","properties":{"name":"Barn","crop":"rye"},"geometry":{"type":"Polygon",
               "coordinates":[[[0,0],[0.01,0],[0.01,0.01],[0,0.01],[0,0]]]}},
              {"type":"Feature","id":"p","properties":{},"geometry":{"type":"Point","coordinates":[0,0]}}]}
            """;
    private static final String SENT =
            "POST /api/fields?domain=north&validFrom=2026-03-01T00%3A00%3A00Z&replace=true&dryRun=true";

    @AutoClose
    private final StubControl control = new StubControl();

    @TempDir
    private Path folder;

    private String file;

    @BeforeEach
    void write() throws Exception {
        file = Files.writeString(folder.resolve("fields.geojson"), FILE).toString();
    }

    @Test
    void saysWhenAFieldEndsAsTablesHaveTimes() {
        control.answer("POST /api/fields/a", "{'status':'ended'}");

        assertThat(control.run("fields", "end", "a", "--at", "2026-10-01T02:00:00.500+02:00"))
                .isZero();

        assertThat(control.output()).isEqualToIgnoringNewLines("Field a ends at 2026-10-01T00:00:00Z.");
        assertThat(control.requested())
                .containsExactly("POST /api/fields/a {\"validTo\":\"2026-10-01T00:00:00.500Z\"}");
    }

    @Test
    void listsTheFieldsOfTheControlPlane() {
        String fields = """
                {'type':'FeatureCollection','features':[
                 {'type':'Feature','id':'a','geometry':{'type':'Polygon','coordinates':[]},'properties':{'validFrom':'2026-03-01T00:00:00.000Z','name':'Barn','Domain':'north'}},
                 {'type':'Feature','id':'a','geometry':null,'properties':{'validFrom':'2026-10-01T00:00:00.000Z'}}]}""";
        control.answer("GET /api/fields", "{'type':'FeatureCollection','features':[]}")
                .answer("GET /api/fields?versions=true", fields)
                .answer("GET /api/fields?at=2026-03-01T00%3A00%3A00Z", fields);

        assertThat(control.run("fields", "list")).isZero();
        assertThat(control.output()).startsWith("There are no fields.");
        assertThat(control.run("fields", "list", "--versions")).isZero();
        assertThat(control.output())
                .containsPattern("a +Barn +north +2026-03-01T00:00:00Z +Polygon")
                .containsPattern("a +- +- +2026-10-01T00:00:00Z +ends");
        assertThat(control.run("fields", "list", "--at", "2026-03-01T00:00:00Z", "-o", "name"))
                .isZero();
        assertThat(control.output().lines()).containsExactly("a", "a");
    }

    @Test
    void listsNoMoreFieldsThanAreRequested() {
        String feature = "{'type':'FeatureCollection','features':[{'id':'%s','geometry':null,'properties':{}}]}";
        control.answerPage("GET /api/fields?limit=1", feature.formatted("a"), "?limit=1&page=2")
                .answerPage("GET /api/fields?limit=2", feature.formatted("a"), "?limit=2&page=2")
                .answer("GET /api/fields?limit=2&page=2", feature.formatted("b"));

        assertThat(control.run("fields", "list", "-n", "1", "-o", "jsonpath={.features[*].id}"))
                .isZero();
        assertThat(control.output().lines()).containsExactly("a", "There are more than 1; --limit shows more of them.");
        assertThat(control.run("fields", "list", "-n", "2", "-o", "name")).isZero();
        assertThat(control.output().lines()).containsExactly("a", "b");
    }

    @Test
    void sendsTheFieldsOfAFileInOneFormAndReportsTheirChanges() {
        control.answer(SENT, """
                {'fields':[{'id':'a','name':'Barn','domain':'north','domainBefore':'','change':'changed','mended':[]},
                           {'id':'b','name':'','domain':'north','change':'ended','mended':[]}]}""");

        assertThat(control.run(
                        "fields",
                        "import",
                        file,
                        "--domain",
                        "north",
                        "--valid-from",
                        "2026-03-01T00:00:00Z",
                        "--replace"))
                .isEqualTo(1);

        assertThat(control.requested())
                .singleElement()
                .asString()
                .startsWith(SENT + " {\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\"id\":\"a\",")
                .contains("\"name\":\"Barn\",\"Domain\":\"north\",\"crop\":\"rye\"")
                .doesNotContain("Point");
        assertThat(control.output())
                .containsPattern("changed +a +Barn +no domain → north +12[0-9.]+")
                .containsPattern("ended +b +- +north")
                .containsPattern("REFUSED +p ")
                .contains("Not written: 0 added, 1 changed, 0 unchanged, 1 ended (north 1), 1 refused")
                .contains("With --replace nothing is written while features are refused");
    }

    @Test
    void reportsThatTheControlPlaneRefuses() {
        assertThat(control.run("fields", "import", file, "--valid-from", "2026-03-01T00:00:00Z"))
                .isEqualTo(1);

        assertThat(control.output())
                .contains("there is no POST /api/fields?validFrom=")
                .doesNotContain("Written");
    }
}
