package io.furrow.control.letter;

import java.nio.ByteBuffer;
import java.nio.charset.CharacterCodingException;
import java.nio.charset.StandardCharsets;
import java.util.Arrays;
import java.util.Base64;
import java.util.LinkedHashMap;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.header.Headers;

import io.furrow.kafka.KafkaClients;
import io.furrow.model.control.JsonObjectReader;
import io.furrow.model.control.RejectedException;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * A record of a topic, as the API shows it, with what a dead letter says about its failure. Dead letters of Kafka Connect, which has
 * headers of its own, are shown alike.
 *
 * @param time of the record, epoch ms
 * @param size of the value in bytes; negative if there is none
 * @param contents null if it is not retained
 */
public record StoredRecord(
        String topic,
        int partition,
        long offset,
        long time,
        String reason,
        String stage,
        String message,
        String source,
        String key,
        int size,
        Contents contents) {
    /** Bytes of a value that are shown. */
    public static final int MAX_SHOWN_BYTES = 64 * 1024;

    private static final int MAX_TEXT_LENGTH = 500;
    private static final int MAX_HEADERS = 100;
    private static final String CONNECT = "__connect.errors.";

    /** @param value its beginning; null if there is none */
    public record Contents(Map<String, String> headers, byte[] value) {
        static Contents of(ConsumerRecord<byte[], byte[]> record) {
            Map<String, String> headers = new LinkedHashMap<>();
            for (Header header : record.headers()) {
                if (headers.size() < MAX_HEADERS) {
                    headers.put(shortened(header.key()), text(record.headers(), header.key()));
                }
            }
            byte[] value = record.value();
            boolean isCut = value != null && value.length > MAX_SHOWN_BYTES;
            return new Contents(headers, isCut ? Arrays.copyOf(value, MAX_SHOWN_BYTES) : value);
        }

        /** Bytes of the value and characters of the headers. */
        int size() {
            int size = value == null ? 0 : value.length;
            for (Map.Entry<String, String> header : headers.entrySet()) {
                size += header.getKey().length()
                        + (header.getValue() == null ? 0 : header.getValue().length());
            }
            return size;
        }
    }

    /** @param whole whether headers and value are retained */
    public static StoredRecord of(ConsumerRecord<byte[], byte[]> letter, boolean whole) {
        Headers headers = letter.headers();
        String topic = text(headers, CONNECT + "topic");
        String connectSource = topic == null
                ? null
                : "%s-%s@%s".formatted(topic, text(headers, CONNECT + "partition"), text(headers, CONNECT + "offset"));
        return new StoredRecord(
                letter.topic(),
                letter.partition(),
                letter.offset(),
                letter.timestamp(),
                first(text(headers, DeadLetter.REASON), simple(text(headers, CONNECT + "exception.class.name"))),
                first(text(headers, DeadLetter.STAGE), text(headers, CONNECT + "connector.name")),
                first(text(headers, DeadLetter.MESSAGE), text(headers, CONNECT + "exception.message")),
                first(text(headers, DeadLetter.SOURCE), connectSource),
                letter.key() == null ? null : shortened(new String(letter.key(), StandardCharsets.UTF_8)),
                letter.value() == null ? -1 : letter.value().length,
                whole ? Contents.of(letter) : null);
    }

    private static String first(String text, String other) {
        return text == null ? other : text;
    }

    private static String simple(String className) {
        return className == null ? null : className.substring(className.lastIndexOf('.') + 1);
    }

    private static String text(Headers headers, String name) {
        String text = KafkaClients.text(headers, name);
        return text == null ? null : shortened(text);
    }

    private static String shortened(String text) {
        String shortened = text.length() <= MAX_TEXT_LENGTH ? text : text.substring(0, MAX_TEXT_LENGTH - 1) + "…";
        // Half of a surrogate pair cannot be written.
        return new String(shortened.getBytes(StandardCharsets.UTF_8), StandardCharsets.UTF_8);
    }

    /** Returns the record, with its headers and the beginning of its value, as JSON, else as text, else in base64, if they are retained. */
    public ObjectNode json() {
        ObjectNode json = NgsiJson.object()
                .put("topic", topic)
                .put("partition", partition)
                .put("offset", offset)
                .put("time", time);
        put(json, "reason", reason);
        put(json, "stage", stage);
        put(json, "message", message);
        put(json, "source", source);
        put(json, "key", key);
        if (size >= 0) {
            json.put("size", size);
        }
        if (contents != null) {
            ObjectNode headers = json.putObject("headers");
            contents.headers().forEach(headers::put);
            if (contents.value() != null) {
                addValue(json, contents.value(), size > contents.value().length);
            }
        }
        return json;
    }

    private static void put(ObjectNode json, String member, String text) {
        if (text != null) {
            json.put(member, text);
        }
    }

    private static void addValue(ObjectNode json, byte[] shown, boolean isCut) {
        JsonNode parsed = isCut ? null : parsed(shown);
        if (parsed != null) {
            json.put("encoding", "json").set("value", parsed);
        } else {
            String text = decoded(shown, isCut);
            json.put("encoding", text == null ? "base64" : "text")
                    .put("value", text == null ? Base64.getEncoder().encodeToString(shown) : text);
        }
        json.put("cut", isCut);
    }

    /** Returns null if the value is not JSON that can be written again. */
    private static JsonNode parsed(byte[] value) {
        try {
            JsonNode json = NgsiJson.read(value);
            JsonObjectReader.checkReadable(json);
            return json;
        } catch (UnreadableException | RejectedException e) {
            return null;
        }
    }

    /** Returns null if the value is not text. @param isCut the last character may be incomplete */
    private static String decoded(byte[] value, boolean isCut) {
        for (int missing = 0; missing <= (isCut ? 3 : 0); missing++) {
            try {
                return StandardCharsets.UTF_8
                        .newDecoder()
                        .decode(ByteBuffer.wrap(value, 0, value.length - missing))
                        .toString();
            } catch (CharacterCodingException e) {
                // is not text up to here
            }
        }
        return null;
    }
}
