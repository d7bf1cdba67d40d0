package io.furrow.connect.source.option;

import java.util.List;
import java.util.Locale;
import java.util.Map;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigException;

import io.furrow.connect.OptionGroup;

/**
 * Options for the representation in which converters and transforms receive records; checks that the connector's own
 * converters support it.
 */
public record RecordOptions(AbstractConfig config) {
    static final String VALUE_MODE = "value.mode";
    static final String KEY_MODE = "key.mode";

    private static final String TEXT_CONVERTER = "org.apache.kafka.connect.storage.StringConverter";
    private static final String BYTES_CONVERTER = "org.apache.kafka.connect.converters.ByteArrayConverter";

    /** Names of converters without the package and without the suffix Converter. */
    private static final Map<String, String> VALUES = Map.of(
            "ByteArray", "bytes",
            "String", "text",
            "Json", "struct|text",
            "Avro", "struct|text",
            "JsonSchema", "struct|text",
            "Protobuf", "struct|text");

    private static final Map<String, String> KEYS = Map.of(
            "ByteArray", "bytes",
            "String", "text",
            "Json", "text",
            "Avro", "text",
            "JsonSchema", "text",
            "Protobuf", "text");

    /** Checks the converters in the connector's configuration; those of the worker are not visible to it. */
    public RecordOptions {
        check(config, "value.converter", VALUE_MODE, VALUES);
        check(config, "key.converter", KEY_MODE, KEYS);
        String headers = converter(config, "header.converter");
        if (headers.equals("ByteArray") || headers.equals("Json")) {
            throw new ConfigException(
                    "header.converter",
                    config.originals().get("header.converter"),
                    "the headers are text, which it cannot write unchanged; set header.converter=" + TEXT_CONVERTER);
        }
    }

    private static void check(AbstractConfig config, String option, String modeOption, Map<String, String> taken) {
        String mode = config.getString(modeOption);
        String modes = taken.get(converter(config, option));
        if (modes != null && !mode.matches(modes)) {
            String instead = mode.equals("bytes") ? BYTES_CONVERTER : TEXT_CONVERTER;
            String other = mode.equals("struct")
                    ? "a " + option + " for structs, such as org.apache.kafka.connect.json.JsonConverter"
                    : option + "=" + instead;
            throw new ConfigException(
                    modeOption,
                    mode,
                    "the connector's " + option + "=" + config.originals().get(option) + " cannot write that; set "
                            + modeOption + "=" + modes.split("\\|")[0] + ", or " + other);
        }
    }

    private static String converter(AbstractConfig config, String option) {
        Object name = config.originals().getOrDefault(option, "");
        return String.valueOf(name).replaceFirst(".*[.]", "").replaceFirst("Converter$", "");
    }

    public static void define(ConfigDef options) {
        OptionGroup group = new OptionGroup(options, "Records");
        group.choice(VALUE_MODE, List.of("bytes", "text", "struct"), "Values")
                .help("Form of the value for the value converter and transforms: the entity's JSON as bytes (for"
                        + " ByteArrayConverter), as text (for StringConverter), or a struct of the schema"
                        + " io.furrow.ngsi.Entity (for JsonConverter and the converters of Avro, JSON Schema and"
                        + " Protobuf, and for value transforms).");
        group.low()
                .choice(KEY_MODE, List.of("text", "bytes"), "Keys")
                .help("Form of the key for the key converter: the entity's id as text, or as bytes (for"
                        + " ByteArrayConverter).");
    }

    public KeyMode keys() {
        return KeyMode.valueOf(config.getString(KEY_MODE).toUpperCase(Locale.ROOT));
    }

    public ValueMode values() {
        return ValueMode.valueOf(config.getString(VALUE_MODE).toUpperCase(Locale.ROOT));
    }
}
