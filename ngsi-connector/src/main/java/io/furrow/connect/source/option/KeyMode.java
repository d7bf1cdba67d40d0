package io.furrow.connect.source.option;

import java.nio.charset.StandardCharsets;

import org.apache.kafka.connect.data.Schema;
import org.apache.kafka.connect.data.SchemaAndValue;

/** The representation of an entity's id for the key converter: text, or its UTF-8 bytes. */
public enum KeyMode {
    TEXT,
    BYTES;

    public SchemaAndValue of(String key) {
        if (key == null) {
            return SchemaAndValue.NULL;
        }
        return this == TEXT
                ? new SchemaAndValue(Schema.STRING_SCHEMA, key)
                : new SchemaAndValue(Schema.BYTES_SCHEMA, key.getBytes(StandardCharsets.UTF_8));
    }
}
