package io.furrow.connect.source;

import java.nio.charset.StandardCharsets;

import org.apache.kafka.connect.data.Schema;
import org.apache.kafka.connect.data.SchemaAndValue;

/** What a key converter gets of an entity's id: its text, or the UTF-8 bytes of it. */
enum KeyMode {
    TEXT,
    BYTES;

    SchemaAndValue of(String key) {
        if (key == null) {
            return SchemaAndValue.NULL;
        }
        return this == TEXT
                ? new SchemaAndValue(Schema.STRING_SCHEMA, key)
                : new SchemaAndValue(Schema.BYTES_SCHEMA, key.getBytes(StandardCharsets.UTF_8));
    }
}
