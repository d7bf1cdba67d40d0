package io.furrow.connect;

import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;
import java.util.stream.StreamSupport;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;

/** A worker with {@code plugin.discovery=hybrid_fail} knows both connectors and says which option is wrong. */
@Tag("full")
class PluginIT {
    private static final String SOURCE = "io.furrow.connect.source.NgsiSourceConnector";
    private static final String SINK = "io.furrow.connect.sink.NgsiSinkConnector";

    @TempDir
    static Path directory;

    @AutoClose
    private static ConnectRig rig;

    @BeforeAll
    static void startWorker() {
        // Refuses to start where a connector is not declared in META-INF/services.
        rig = ConnectRig.start(directory, Map.of("plugin.discovery", "hybrid_fail"));
    }

    @Test
    void isListedWithItsVersion() {
        List<String> known = StreamSupport.stream(rig.get("/connector-plugins").spliterator(), false)
                .map(plugin -> plugin.path("class").asText() + " "
                        + plugin.path("type").asText() + " "
                        + plugin.path("version").asText().replaceAll("\\d+\\.\\d+\\.\\d+(-SNAPSHOT)?", "N"))
                .toList();

        assertThat(known).contains(SOURCE + " source N", SINK + " sink N");
    }

    @ParameterizedTest
    @CsvSource({
        SINK + ", context.broker.url, orion:1026",
        SINK + ", retry.backoff.max.ms, 10",
        SINK + ", api, ngsi-v1",
        SOURCE + ", listen.port, 70000",
        SOURCE + ", listen.request.timeout.ms, 1000",
        SOURCE + ", topic, a b"
    })
    void namesTheOptionThatIsWrong(String connector, String option, String value) {
        ObjectNode options = NgsiJson.mapper().createObjectNode();
        options.put("name", "checked")
                .put("connector.class", connector)
                .put("topics", "t")
                .put("tasks.max", "1")
                .put("context.broker.url", "http://127.0.0.1:1026")
                .put("journal.dir", directory.resolve("journal").toString())
                .put(option, value);
        if (connector.equals(SOURCE)) {
            options.remove("topics");
        }

        JsonNode answer = rig.put("/connector-plugins/" + connector + "/config/validate", options);

        Set<String> wrong = new TreeSet<>();
        for (JsonNode each : answer.path("configs")) {
            if (!each.at("/value/errors").isEmpty()) {
                wrong.add(each.at("/value/name").asText());
            }
        }
        assertThat(wrong).as(answer.toString()).containsExactly(option);
        assertThat(answer.path("error_count").intValue()).isPositive();
    }

    @Test
    void offersTheValuesOfAnEnumerationAndHidesWhatDoesNotApply() {
        ObjectNode options = NgsiJson.mapper().createObjectNode();
        options.put("name", "offered")
                .put("connector.class", SINK)
                .put("topics", "t")
                .put("tasks.max", "1");
        options.put("context.broker.url", "http://127.0.0.1:1026");

        JsonNode answer = rig.put("/connector-plugins/" + SINK + "/config/validate", options);

        assertThat(value(answer, "api").path("recommended_values")).hasToString("[\"ngsi-v2\",\"ngsi-ld\"]");
        assertThat(value(answer, "context.broker.ssl.truststore.location")
                        .path("visible")
                        .booleanValue())
                .isFalse();
        assertThat(value(answer, "time.metadata").path("visible").booleanValue())
                .isTrue();
    }

    private static JsonNode value(JsonNode answer, String option) {
        for (JsonNode each : answer.path("configs")) {
            if (each.at("/value/name").asText().equals(option)) {
                return each.path("value");
            }
        }
        throw new AssertionError("no option " + option);
    }
}
