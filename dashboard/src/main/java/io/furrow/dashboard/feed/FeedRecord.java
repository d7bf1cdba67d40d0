package io.furrow.dashboard.feed;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.util.HashSet;
import java.util.Objects;
import java.util.Set;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonToken;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.common.header.Header;

import io.furrow.kafka.KafkaClients;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.result.ResultTypes;

/**
 * A record for the streams of a topic. Encodes text and envelope once for all streams, except those of the initial state,
 * which may wait for long.
 */
public final class FeedRecord {
    /** Sequence of a record of the initial state. */
    public static final long NO_SEQUENCE = -1;

    private static final int ENVELOPE = 200;
    private static final char SEPARATOR = '\n';
    private static final String ENTITY_TYPE = "entity-type";

    private final ConsumerRecord<byte[], byte[]> record;
    private final long sequence;
    private final int maxValueBytes;
    private String text;
    private String envelope;
    private String type;
    private String id;

    /**
     * @param sequence number within the topic; {@link #NO_SEQUENCE} for the initial state
     * @param maxValueBytes longest value that the envelope contains
     */
    public FeedRecord(ConsumerRecord<byte[], byte[]> record, long sequence, int maxValueBytes) {
        this.record = record;
        this.sequence = sequence;
        this.maxValueBytes = maxValueBytes;
    }

    /**
     * A newer record replaces older ones with the same key: {@link #keyWithoutType}, the entity type, and the entity id
     * of a result, because the records of two results may have the same key, for instance those of an encounter, of its
     * prediction and of the encounter with another tenant's device of the same id.
     */
    public String key() {
        String typed = type().isEmpty() ? keyWithoutType() : keyWithoutType() + SEPARATOR + type();
        return ResultTypes.isResult(type()) ? typed + SEPARATOR + id : typed;
    }

    /** Tenant, service path and key; partition and offset for a record without a key. */
    public String keyWithoutType() {
        return record.key() == null
                ? record.partition() + "/" + record.offset()
                : KafkaClients.scope(record.headers()).identity(recordKey());
    }

    /**
     * Whether this record deletes the other. A deletion without tenant and path, or without a type, matches all of
     * them.
     */
    boolean deletes(FeedRecord other) {
        boolean namesScope = header(HeaderNames.SERVICE) != null || header(HeaderNames.SERVICE_PATH) != null;
        boolean sameKey = namesScope
                ? keyWithoutType().equals(other.keyWithoutType())
                : Objects.equals(recordKey(), other.recordKey());
        return record.value() == null && sameKey && (type().isEmpty() || type().equals(other.type()));
    }

    private String recordKey() {
        return record.key() == null ? null : new String(record.key(), StandardCharsets.UTF_8);
    }

    /**
     * The type of an entity, or of an image's entity, since entities with the same id may differ only in type. Empty
     * for any other record.
     */
    private synchronized String type() {
        if (type == null) {
            type = record.value() == null
                    ? Objects.requireNonNullElse(header(ENTITY_TYPE), "")
                    : readType(record.value());
        }
        return type;
    }

    /** Also reads the id. */
    private String readType(byte[] value) {
        String read = "";
        try (JsonParser parser = NgsiJson.mapper().createParser(value)) {
            boolean isObject = parser.nextToken() == JsonToken.START_OBJECT;
            while (isObject && (id == null || read.isEmpty()) && parser.nextToken() == JsonToken.FIELD_NAME) {
                String name = parser.currentName();
                boolean isText = parser.nextToken() == JsonToken.VALUE_STRING;
                id = isText && (name.equals("id") || name.equals("entity")) ? parser.getText() : id;
                read = isText && name.equals("type") ? parser.getText() : read;
                parser.skipChildren();
            }
        } catch (IOException e) {
            return ""; // sent as text
        }
        return id == null ? "" : read;
    }

    private String header(String name) {
        return KafkaClients.text(record.headers(), name);
    }

    /** Approximate memory until the record is sent. */
    public int bytes() {
        return ENVELOPE + (record.value() == null ? 0 : record.value().length);
    }

    /** The value as text; {@code null} for a deletion. */
    public synchronized String text() {
        if (text != null) {
            return text;
        }
        String created = record.value() == null ? "null" : new String(record.value(), StandardCharsets.UTF_8);
        text = sequence == NO_SEQUENCE ? null : created;
        return created;
    }

    /** The record as a JSON object with all its members. */
    public synchronized String envelope() {
        if (envelope != null) {
            return envelope;
        }
        String created = createEnvelope();
        envelope = sequence == NO_SEQUENCE ? null : created;
        return created;
    }

    private String createEnvelope() {
        ObjectNode json = NgsiJson.object()
                .put("topic", record.topic())
                .put("partition", record.partition())
                .put("offset", record.offset())
                .put("kind", sequence == NO_SEQUENCE ? "prime" : "event")
                .put("key", recordKey())
                .put("time", record.timestamp());
        if (sequence != NO_SEQUENCE) {
            json.put("sequence", sequence);
        }
        ObjectNode headers = json.putObject("headers");
        Set<String> seen = new HashSet<>();
        for (Header header : record.headers()) {
            if (header.value() != null && seen.add(header.key())) {
                headers.put(header.key(), new String(header.value(), StandardCharsets.UTF_8));
            }
        }
        byte[] value = record.value();
        if (value == null) {
            json.putNull("value");
        } else if (value.length > maxValueBytes) {
            json.putNull("value").put("cut", value.length);
        } else if (!isJson(value)) {
            json.put("value", text());
        } else {
            String head = new String(NgsiJson.write(json), StandardCharsets.UTF_8);
            return head.substring(0, head.length() - 1) + ",\"value\":" + text() + "}";
        }
        return new String(NgsiJson.write(json), StandardCharsets.UTF_8);
    }

    private static boolean isJson(byte[] value) {
        try (JsonParser parser = NgsiJson.mapper().createParser(value)) {
            if (parser.nextToken() == null) {
                return false;
            }
            parser.skipChildren();
            return parser.nextToken() == null;
        } catch (IOException e) {
            return false;
        }
    }
}
