package io.furrow.connect.source;

import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.apache.kafka.common.config.ConfigValue;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;

/** Converters that cannot write what the source makes are refused when the connector is made, with the setting that can. */
class ConvertersTest {
    private static final String JSON = "org.apache.kafka.connect.json.JsonConverter";
    private static final String BYTES = "org.apache.kafka.connect.converters.ByteArrayConverter";
    private static final String TEXT = "org.apache.kafka.connect.storage.StringConverter";

    @ParameterizedTest
    @CsvSource({
        "value, bytes, " + JSON + ", value.mode=struct",
        "value, bytes, " + TEXT + ", value.mode=text",
        "value, bytes, io.confluent.connect.avro.AvroConverter, value.mode=struct",
        "value, bytes, io.confluent.connect.protobuf.ProtobufConverter, value.mode=struct",
        "value, bytes, JsonSchemaConverter, value.mode=struct",
        "value, text, " + BYTES + ", value.mode=bytes",
        "value, struct, " + BYTES + ", value.mode=bytes",
        "value, struct, " + TEXT + ", value.mode=text",
        "key, text, " + BYTES + ", key.mode=bytes",
        "key, bytes, " + TEXT + ", key.mode=text",
        "key, bytes, " + JSON + ", key.mode=text"
    })
    void areRefusedWhereTheyCannotWriteTheMode(String of, String mode, String converter, String remedy) {
        List<ConfigValue> wrong = wrong(Map.of(of + ".mode", mode, of + ".converter", converter));

        assertThat(wrong).singleElement().satisfies(value -> {
            assertThat(value.name()).isEqualTo(of + ".mode");
            assertThat(value.errorMessages()).singleElement().asString().contains(converter, remedy);
        });
    }

    @ParameterizedTest
    @CsvSource({BYTES, JSON})
    void areRefusedForHeadersThatTheyCannotWriteAsText(String converter) {
        assertThat(wrong(Map.of("header.converter", converter))).singleElement().satisfies(value -> {
            assertThat(value.name()).isEqualTo("header.converter");
            assertThat(value.errorMessages()).singleElement().asString().contains(TEXT);
        });
    }

    @ParameterizedTest
    @CsvSource({
        "value, bytes, " + BYTES,
        "value, text, " + TEXT,
        "value, text, " + JSON,
        "value, struct, " + JSON,
        "value, struct, io.confluent.connect.avro.AvroConverter",
        "value, struct, org.example.OurConverter",
        "value, bytes, org.example.OurConverter",
        "key, text, " + TEXT,
        "key, text, " + JSON,
        "key, bytes, " + BYTES,
        "header, , org.apache.kafka.connect.storage.SimpleHeaderConverter",
        "header, , " + TEXT
    })
    void areTakenWhereTheyCanOrAreNotKnown(String of, String mode, String converter) {
        Map<String, String> options = new HashMap<>(Map.of(of + ".converter", converter));
        if (mode != null) {
            options.put(of + ".mode", mode);
        }

        assertThat(wrong(options)).isEmpty();
    }

    private static List<ConfigValue> wrong(Map<String, String> options) {
        Map<String, String> all = new HashMap<>(Map.of("name", "n", "journal.dir", "/tmp/journal"));
        all.putAll(options);
        return new NgsiSourceConnector()
                .validate(all).configValues().stream()
                        .filter(value -> !value.errorMessages().isEmpty())
                        .toList();
    }
}
