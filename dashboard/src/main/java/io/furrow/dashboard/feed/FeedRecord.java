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

/** A record on its way to the streams of a topic; what is made of it is made once for all of them. */
public final class FeedRecord {
    /** Of a record of the known state. */
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

    /**
     * @param sequence among those of its topic, {@link #NO_SEQUENCE} for the known state
     * @param maxValueBytes value, bytes, that an envelope holds
     */
    public FeedRecord(ConsumerRecord<byte[], byte[]> record, long sequence, int maxValueBytes) {
        this.record = record;
        this.sequence = sequence;
        this.maxValueBytes = maxValueBytes;
    }

    /** By which newer ones take the place of older ones: that of {@link #ofAllTypes}, and the type of the entity. */
    public String key() {
        return type().isEmpty() ? ofAllTypes() : ofAllTypes() + SEPARATOR + type();
    }

    /** Tenant, service path and key; of a record without a key its own place. */
    public String ofAllTypes() {
        return record.key() == null
                ? record.partition() + "/" + record.offset()
                : KafkaClients.scope(record.headers()).identity(recordKey());
    }

    /** Whether it deletes what another one reports; a deletion that names no tenant and path, or no type, is one of all of them. */
    boolean deletes(FeedRecord other) {
        boolean namesScope = header(HeaderNames.SERVICE) != null || header(HeaderNames.SERVICE_PATH) != null;
        boolean isOfIt =
                namesScope ? ofAllTypes().equals(other.ofAllTypes()) : Objects.equals(recordKey(), other.recordKey());
        return record.value() == null && isOfIt && (type().isEmpty() || type().equals(other.type()));
    }

    private String recordKey() {
        return record.key() == null ? null : new String(record.key(), StandardCharsets.UTF_8);
    }

    /** Of an entity, or of a picture of one: two of one id may differ in nothing else. Empty for any other record. */
    private synchronized String type() {
        if (type == null) {
            type = record.value() == null
                    ? Objects.requireNonNullElse(header(ENTITY_TYPE), "")
                    : typeOf(record.value());
        }
        return type;
    }

    private static String typeOf(byte[] value) {
        String type = "";
        boolean hasId = false;
        try (JsonParser parser = NgsiJson.mapper().createParser(value)) {
            boolean isObject = parser.nextToken() == JsonToken.START_OBJECT;
            while (isObject && (!hasId || type.isEmpty()) && parser.nextToken() == JsonToken.FIELD_NAME) {
                String name = parser.currentName();
                boolean isText = parser.nextToken() == JsonToken.VALUE_STRING;
                hasId |= isText && (name.equals("id") || name.equals("entity"));
                type = isText && name.equals("type") ? parser.getText() : type;
                parser.skipChildren();
            }
        } catch (IOException e) {
            return ""; // it is shown as a text
        }
        return hasId ? type : "";
    }

    private String header(String name) {
        return KafkaClients.text(record.headers(), name);
    }

    /** About what it takes in memory until it is sent. */
    public int bytes() {
        return ENVELOPE + (record.value() == null ? 0 : record.value().length);
    }

    /** The value as it is; {@code null} for a deletion. */
    public synchronized String text() {
        if (text == null) {
            text = record.value() == null ? "null" : new String(record.value(), StandardCharsets.UTF_8);
        }
        return text;
    }

    /** The JSON object that says all of it. */
    public synchronized String envelope() {
        if (envelope == null) {
            envelope = made();
        }
        return envelope;
    }

    private String made() {
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
