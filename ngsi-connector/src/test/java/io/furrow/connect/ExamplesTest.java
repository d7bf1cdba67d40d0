package io.furrow.connect;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.connect.connector.Connector;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.connect.sink.NgsiSinkConnector;
import io.furrow.connect.source.NgsiSourceConnector;
import io.furrow.files.Folders;
import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;

/** The examples in config/ hold options that exist, with values that are valid. */
class ExamplesTest {
    private static final Pattern OF_CONNECT = Pattern.compile("name|connector\\.class|tasks\\.max|topics"
            + "|(key|value|header)\\.converter(\\..*)?|(producer|consumer|admin)\\.override\\..*|topic\\.creation\\.default\\..*|errors\\..*"
            + "|exactly\\.once\\.support|offsets\\.storage\\.topic");

    static List<Path> examples() throws IOException {
        return Folders.list(Path.of("config"));
    }

    @Test
    void areAllThatTheReadmeNeeds() throws IOException {
        assertThat(examples()).hasSizeGreaterThanOrEqualTo(6);
    }

    @ParameterizedTest
    @MethodSource("examples")
    void areValid(Path example) throws Exception {
        JsonNode json = NgsiJson.read(Files.readAllBytes(example));
        assertThat(example.getFileName().toString())
                .startsWith(json.path("name").textValue());
        requireValid(json.path("config"));
    }

    @ParameterizedTest
    @ValueSource(strings = {"ngsi-source.json", "ngsi-sink.json"})
    void areValidInContainersToo(String config) throws Exception {
        requireValid(NgsiJson.read(Files.readAllBytes(Path.of("..", "docker", "connectors", config))));
    }

    private void requireValid(JsonNode config) throws Exception {
        Map<String, String> options = new HashMap<>();
        for (Map.Entry<String, JsonNode> option : config.properties()) {
            options.put(option.getKey(), resolved(option.getValue().textValue()));
        }
        Connector connector = connector(options.get("connector.class"));

        assertThat(connector.validate(options).configValues())
                .allSatisfy(value -> assertThat(value.errorMessages()).isEmpty());
        assertThat(options.keySet())
                .allSatisfy(name -> assertThat(OF_CONNECT.matcher(name).matches()
                                || connector.config().names().contains(name))
                        .as(name)
                        .isTrue());
    }

    /** As a config provider would: the value does not matter, only that there is one. */
    private String resolved(String value) throws IOException {
        if (value.matches("\\$\\{\\w+:.*}")) {
            return "from-a-config-provider";
        }
        return value;
    }

    private static Connector connector(String name) {
        return name.equals(NgsiSinkConnector.class.getName()) ? new NgsiSinkConnector() : new NgsiSourceConnector();
    }
}
