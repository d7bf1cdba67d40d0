package io.furrow.cli.command;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Properties;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;

import io.furrow.cli.Commands;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.FreePort;
import io.furrow.kafka.field.FieldEdit;
import io.furrow.kafka.field.FieldsTopic;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

@Tag("full")
class FieldsCommandGroupIT {
    private static final String FEATURE = "{\"type\":\"Feature\",\"id\":\"%s\",\"properties\":{\"name\":\"Field"
            + " %1$s\"},\"geometry\":{\"type\":\"Polygon\","
            + "\"coordinates\":[[[0,0],[%s,0],[0.01,0.01],[0,0.01],[0,0]]]}}";

    @TempDir
    static Path folder;

    @AutoClose
    private static EmbeddedKafka kafka;

    private final StringWriter err = new StringWriter();

    @BeforeAll
    static void start() throws Exception {
        kafka = EmbeddedKafka.start(folder.resolve("kafka"), 0);
    }

    @AfterEach
    void takeAllBack() throws Exception {
        FieldsTopic topic = topic();
        topic.write(new FieldEdit(
                List.of(), topic.read().stream().map(FieldVersion::key).toList()));
    }

    private static FieldsTopic topic() {
        Properties client = kafka.client();
        return new FieldsTopic(client);
    }

    @Test
    void retainsTheFieldsOfAFileAndWhatBecomesOfThem() throws Exception {
        String first = file(FEATURE.formatted("a", "0.01"), FEATURE.formatted("b", "0.01"));
        assertThat(output(0, "import", first, "--dry-run")).contains("Not written: 2 added");
        assertThat(output(0, "list")).startsWith("There are no fields.");

        assertThat(output(0, "import", first, "--valid-from", "2026-03-01T00:00:00Z"))
                .contains("WGS 84 → WGS 84")
                .containsPattern("added +a +Field a +- +[\\d.]+")
                .contains("Written: 2 added, 0 changed, 0 unchanged, 0 ended, 0 refused");
        assertThat(output(0, "import", first, "--valid-from", "2026-03-02T00:00:00Z"))
                .contains("2 unchanged");

        String second = file(FEATURE.formatted("b", "0.02"), FEATURE.formatted("c", "0.01"));
        JsonNode report = NgsiJson.read(output(
                        0,
                        "import",
                        second,
                        "--valid-from",
                        "2026-04-01T00:00:00+02:00",
                        "--replace",
                        "--output",
                        "json")
                .getBytes(UTF_8));
        assertThat(report.path("validFrom").asText()).isEqualTo("2026-03-31T22:00:00Z");
        assertThat(report.path("fields"))
                .extracting(field ->
                        field.path("id").asText() + " " + field.path("change").asText())
                .containsExactly("b changed", "c added", "a ended");

        assertThat(ids("list", "--at", "2026-02-28T00:00:00Z")).isEmpty();
        assertThat(ids("list", "--at", "2026-03-01T00:00:00Z")).containsExactly("a", "b");
        assertThat(ids("list")).containsExactly("b", "c");
        assertThat(ids("list", "--versions")).containsExactly("a", "a", "b", "b", "c");
        assertThat(output(0, "list", "--versions")).containsPattern("a +- +- +2026-03-31T22:00:00Z +ends");

        String broken = file(FEATURE.formatted("d e", "0.01"), FEATURE.formatted("f", "0.01"));
        assertThat(output(1, "import", broken, "--replace")).contains("REFUSED", "d e", "Not written");
        assertThat(err.toString()).contains("With --replace nothing is written while features are refused");
        assertThat(ids("list")).containsExactly("b", "c");
        assertThat(output(1, "import", broken)).contains("Written: 1 added");
        assertThat(ids("list")).containsExactly("b", "c", "f");
    }

    @Test
    void replacesTheFieldsOfOneDomainOnlyWhereItIsNamed() throws Exception {
        for (String domain : List.of("north", "a-domain-with-a-name-that-is-longer-than-any-column")) {
            output(0, "import", file(FEATURE.formatted("of-" + domain, "0.01")), "--domain", domain);
        }
        output(0, "import", file(FEATURE.formatted("of-none", "0.01")));

        String whole = file(FEATURE.formatted("new", "0.01"));
        assertThat(output(0, "import", whole, "--replace", "--dry-run"))
                .containsPattern("ended +of-north +Field of-north +north +- +-")
                .containsPattern("ended +of-none +Field of-none +- +- +-")
                .contains("3 ended (a-domain-with-a-name-that-is-longer-than-any-column 1, no domain 1, north 1)");
        assertThat(output(0, "import", whole, "--domain", "north", "--replace")).contains("1 ended (north 1)");
        assertThat(output(0, "import", whole, "--domain", "south"))
                .containsPattern("changed +new +Field new +north → south");
        assertThat(ids("list"))
                .containsExactly("new", "of-a-domain-with-a-name-that-is-longer-than-any-column", "of-none");
        assertThat(output(0, "list")
                        .lines()
                        .map(line -> line.indexOf("Polygon"))
                        .skip(1))
                .as("the columns are below each other")
                .hasSize(3)
                .containsOnly(
                        output(0, "list").lines().findFirst().orElseThrow().indexOf("SHAPE"));
    }

    @Test
    void rejectsAreasThatOthersPutThere() throws Exception {
        FieldsTopic topic = topic();
        String crossing = "{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[2,2],[2,0],[0,2],[0,0]]]}";
        FieldVersion bow = new FieldVersion(
                "bow",
                0,
                (ObjectNode) NgsiJson.read(crossing.getBytes(UTF_8)),
                NgsiJson.mapper().createObjectNode());
        topic.write(List.of(bow));

        assertThat(ids("list", "--versions")).doesNotContain("bow");
        assertThat(topic.keys("bow")).containsExactly(bow.key());
        topic.write(new FieldEdit(List.of(), topic.keys("bow")));
        assertThat(topic.keys("bow")).isEmpty();
    }

    @Test
    void reportsWhatIsWrong() throws Exception {
        output(1, "import", folder.resolve("missing").toString());
        assertThat(err.toString())
                .contains("missing cannot be read: there is no such file")
                .doesNotContain("Exception");
        output(2, "import", file(), "--valid-from", "yesterday");
        assertThat(err.toString()).contains("'yesterday' is not a time; write for instance");
        output(1, "list", "--kafka", "127.0.0.1:" + FreePort.orFree(0));
        assertThat(err.toString()).contains("cannot be read").contains("Check the address given with --kafka");
    }

    private static String file(String... features) throws Exception {
        Path file = folder.resolve("fields.geojson");
        Files.writeString(file, "{\"type\":\"FeatureCollection\",\"features\":[" + String.join(",", features) + "]}");
        return file.toString();
    }

    private List<String> ids(String... args) throws Exception {
        List<String> all = new ArrayList<>(List.of(args));
        all.addAll(List.of("--output", "json"));
        List<String> ids = new ArrayList<>();
        NgsiJson.read(output(0, all.toArray(String[]::new)).getBytes(UTF_8))
                .path("features")
                .forEach(feature -> ids.add(feature.path("id").asText()));
        return ids;
    }

    private String output(int exitCode, String... args) {
        StringWriter output = new StringWriter();
        CommandLine line = Commands.commandLine(CommandSpec.create().name("furrow"), Commands.ALL);
        line.setOut(new PrintWriter(output, true)).setErr(new PrintWriter(err, true));
        List<String> all = new ArrayList<>(List.of("fields"));
        all.addAll(List.of(args));
        if (!all.contains("--kafka")) {
            all.addAll(List.of("--kafka", kafka.bootstrapServers()));
        }
        assertThat(line.execute(all.toArray(String[]::new))).as(err.toString()).isEqualTo(exitCode);
        return output.toString();
    }
}
