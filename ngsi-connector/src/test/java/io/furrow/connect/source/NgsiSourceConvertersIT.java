package io.furrow.connect.source;

import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.connect.ConnectRig;
import io.furrow.connect.TopicReader;
import io.furrow.embedded.FreePort;
import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;

/** A worker's own converters and value transforms take what the source makes, or the worker refuses the connector. */
@Tag("full")
class NgsiSourceConvertersIT {
    private static final String JSON = "org.apache.kafka.connect.json.JsonConverter";

    @TempDir
    static Path directory;

    @AutoClose
    private static ConnectRig rig;

    @BeforeAll
    static void startWorker() {
        rig = ConnectRig.start(directory);
    }

    @Test
    void writesTransformedStructsAsJson() throws Exception {
        int port = FreePort.orFree(0);
        Map<String, String> options = new HashMap<>(Map.of(
                "topic", "structs",
                "listen.port", Integer.toString(port),
                "value.mode", "struct",
                "value.converter", JSON,
                "value.converter.schemas.enable", "false"));
        options.putAll(Map.of(
                "transforms", "farm",
                "transforms.farm.type", "org.apache.kafka.connect.transforms.InsertField$Value",
                "transforms.farm.static.field", "farm",
                "transforms.farm.static.value", "rye"));
        rig.create("ngsi-source", options);
        SourceOnConnect source = new SourceOnConnect(port);
        source.awaitListening();

        source.take("a", 1);

        try (TopicReader reader = new TopicReader(rig.bootstrapServers(), "structs")) {
            JsonNode value = NgsiJson.read(reader.atLeast(1).get(0).value());
            assertThat(value.at("/id").textValue()).isEqualTo("a-0");
            assertThat(value.at("/farm").textValue()).isEqualTo("rye");
            assertThat(value.at("/attributes/x/numberValue").intValue()).isEqualTo(1);
        }
    }

    @Test
    void isRefusedWithAConverterThatCannotWriteItsValuesOrHeaders() throws Exception {
        ObjectNode config =
                (ObjectNode) NgsiJson.read(java.nio.file.Files.readAllBytes(Path.of("config", "ngsi-source.json")))
                        .path("config");
        config.put("value.converter", JSON);
        HttpResponse<String> values = rig.ask("PUT", "/connectors/other/config", config.toString());
        assertThat(values.statusCode()).as(values.body()).isEqualTo(400);
        assertThat(values.body()).contains("set value.mode=struct");

        config.put("value.mode", "struct").put("header.converter", JSON);
        HttpResponse<String> headers = rig.ask("PUT", "/connectors/other/config", config.toString());
        assertThat(headers.statusCode()).as(headers.body()).isEqualTo(400);
        assertThat(headers.body()).contains("header.converter=org.apache.kafka.connect.storage.StringConverter");
    }
}
