package io.furrow.connect.source.option;

import java.nio.ByteBuffer;
import java.nio.charset.CharacterCodingException;
import java.nio.charset.StandardCharsets;
import java.util.Base64;

import org.apache.kafka.connect.data.Schema;
import org.apache.kafka.connect.data.SchemaAndValue;
import org.apache.kafka.connect.data.SchemaBuilder;
import org.apache.kafka.connect.data.Struct;
import org.apache.kafka.connect.header.Headers;

import io.furrow.connect.record.EntityStruct;
import io.furrow.connect.record.KafkaRecord;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;

/** The representation of a value for a converter and value transforms: the bytes of the JSON, its text, or a struct. */
public enum ValueMode {
    /** JSON as bytes; a dead letter's original bytes. */
    BYTES {
        @Override
        public SchemaAndValue of(KafkaRecord record, Headers headers) {
            Schema schema = record.value() == null ? Schema.OPTIONAL_BYTES_SCHEMA : Schema.BYTES_SCHEMA;
            return new SchemaAndValue(schema, record.value());
        }
    },

    /** JSON as text; a dead letter that is not UTF-8 is base64, marked by a header. */
    TEXT {
        @Override
        public SchemaAndValue of(KafkaRecord record, Headers headers) {
            if (record.value() == null) {
                return SchemaAndValue.NULL;
            }
            try {
                String text = StandardCharsets.UTF_8
                        .newDecoder()
                        .decode(ByteBuffer.wrap(record.value()))
                        .toString();
                return new SchemaAndValue(Schema.STRING_SCHEMA, text);
            } catch (CharacterCodingException e) {
                headers.addString(DEAD_ENCODING, "base64");
                return new SchemaAndValue(
                        Schema.STRING_SCHEMA, Base64.getEncoder().encodeToString(record.value()));
            }
        }
    },

    /** An {@link EntityStruct}; a dead letter as a struct of its original bytes. */
    STRUCT {
        @Override
        public SchemaAndValue of(KafkaRecord record, Headers headers) {
            if (record.value() == null) {
                return SchemaAndValue.NULL;
            }
            if (record.headers().containsKey(DeadLetter.REASON)) {
                return new SchemaAndValue(DEAD_LETTER, new Struct(DEAD_LETTER).put("body", record.value()));
            }
            try {
                return new SchemaAndValue(EntityStruct.ENTITY, EntityStruct.of(Entity.parse(record.value())));
            } catch (UnreadableException e) {
                throw new IllegalArgumentException("a value that is not an entity: " + e.getMessage(), e);
            }
        }
    };

    static final String DEAD_ENCODING = "dead-encoding";

    static final Schema DEAD_LETTER = SchemaBuilder.struct()
            .name("io.furrow.ngsi.DeadLetter")
            .version(1)
            .field("body", Schema.BYTES_SCHEMA)
            .build();

    /**
     * The value of a record; no schema for a tombstone, which every converter accepts as one.
     *
     * @param headers may receive one more
     * @throws IllegalArgumentException if the record's value is neither an entity nor a dead letter
     */
    public abstract SchemaAndValue of(KafkaRecord record, Headers headers);
}
