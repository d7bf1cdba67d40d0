package io.furrow.mission.mongo;

import java.util.Map;
import java.util.TreeMap;
import java.util.function.UnaryOperator;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.bson.BsonBinaryWriter;
import org.bson.BsonDocument;
import org.bson.BsonReader;
import org.bson.BsonType;
import org.bson.BsonWriter;
import org.bson.io.BasicOutputBuffer;

import io.furrow.mission.StoredEvent;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Encodes an event as a document: {@code _id} (event id), the reported entity, {@code _time} (event time, a date) and
 * {@code _headers} (hop stamps as 64-bit numbers, the rest as text). A deletion has {@code id} and {@code _deleted}.
 * {@link FieldName} encodes names and {@link BsonNumbers} numbers; {@link #read} returns exactly the event of {@link
 * #write}.
 */
public final class EventDocumentCodec {
    public static final String ID = "_id";
    public static final String TIME = "_time";
    static final String ENTITY_ID = "id";

    static final String HEADERS = "_headers";
    private static final String DELETED = "_deleted";
    private static final String STAMP = "ts-";
    private static final Pattern STAMPED = Pattern.compile("[1-9]\\d{0,17}");
    /** The server's limit less the room that the command around the document may need. */
    private static final int MAX_BYTES = 16 * 1024 * 1024 - 16 * 1024;

    private static final JsonNodeFactory NODES = new JsonNodeFactory(true);

    private EventDocumentCodec() {}

    /**
     * @throws UnreadableException with {@link Reason#REFUSED} or {@link Reason#TOO_LARGE} for an event that no document
     * can hold
     */
    public static byte[] write(StoredEvent event) throws UnreadableException {
        try (BasicOutputBuffer buffer = new BasicOutputBuffer(2048);
                BsonBinaryWriter out = new BsonBinaryWriter(buffer)) {
            out.writeStartDocument();
            out.writeString(ID, event.id());
            if (event.entity() == null) {
                out.writeString(ENTITY_ID, event.entityId());
                out.writeBoolean(DELETED, true);
            } else {
                writeMembers(out, event.entity(), FieldName::ofAttribute);
            }
            out.writeDateTime(TIME, event.time());
            writeHeaders(out, event.headers());
            out.writeEndDocument();
            if (buffer.getSize() > MAX_BYTES) {
                throw new UnreadableException(
                        Reason.TOO_LARGE,
                        "a document of %d bytes is more than MongoDB takes, which is 16 MiB"
                                .formatted(buffer.getSize()));
            }
            return buffer.toByteArray();
        }
    }

    private static void writeHeaders(BsonWriter out, Map<String, String> headers) {
        out.writeStartDocument(HEADERS);
        new TreeMap<>(headers).forEach((name, text) -> {
            out.writeName(FieldName.of(name));
            if (isStamp(name, text)) {
                out.writeInt64(Long.parseLong(text));
            } else {
                out.writeString(text);
            }
        });
        out.writeEndDocument();
    }

    /** Returns whether a header can be stored as a number without changing its text. */
    private static boolean isStamp(String name, String text) {
        return name.startsWith(STAMP) && STAMPED.matcher(text).matches();
    }

    private static void writeMembers(BsonWriter out, JsonNode object, UnaryOperator<String> fieldOf)
            throws UnreadableException {
        for (Map.Entry<String, JsonNode> member : object.properties()) {
            out.writeName(fieldOf.apply(member.getKey()));
            writeValue(out, member.getValue());
        }
    }

    private static void writeValue(BsonWriter out, JsonNode value) throws UnreadableException {
        switch (value.getNodeType()) {
            case OBJECT -> {
                out.writeStartDocument();
                writeMembers(out, value, FieldName::of);
                out.writeEndDocument();
            }
            case ARRAY -> {
                out.writeStartArray();
                for (JsonNode element : value) {
                    writeValue(out, element);
                }
                out.writeEndArray();
            }
            case STRING -> out.writeString(value.textValue());
            case NUMBER -> BsonNumbers.write(out, value);
            case BOOLEAN -> out.writeBoolean(value.booleanValue());
            default -> out.writeNull();
        }
    }

    /**
     * @throws UnreadableException with {@link Reason#NOT_AN_EVENT} for a document that was not written by {@link #write}
     */
    public static StoredEvent read(BsonDocument document) throws UnreadableException {
        BsonReader in = document.asBsonReader();
        String id = null;
        long time = Long.MIN_VALUE;
        boolean deleted = false;
        Map<String, String> headers = new TreeMap<>();
        ObjectNode entity = NODES.objectNode();
        in.readStartDocument();
        while (in.readBsonType() != BsonType.END_OF_DOCUMENT) {
            String field = in.readName();
            switch (field) {
                case ID -> id = readValue(in).asText();
                case TIME -> time = in.getCurrentBsonType() == BsonType.DATE_TIME ? in.readDateTime() : time;
                case DELETED -> deleted = in.readBoolean();
                case HEADERS ->
                    readObject(in)
                            .properties()
                            .forEach(h -> headers.put(h.getKey(), h.getValue().asText()));
                default -> entity.set(FieldName.decode(field), readValue(in));
            }
        }
        if (id == null || time == Long.MIN_VALUE || !entity.path(ENTITY_ID).isTextual()) {
            throw new UnreadableException(
                    Reason.NOT_AN_EVENT, "document " + document.get(ID) + " has no _id, no _time or no id");
        }
        return new StoredEvent(id, time, entity.get(ENTITY_ID).textValue(), headers, deleted ? null : entity);
    }

    private static ObjectNode readObject(BsonReader in) throws UnreadableException {
        ObjectNode object = NODES.objectNode();
        in.readStartDocument();
        while (in.readBsonType() != BsonType.END_OF_DOCUMENT) {
            object.set(FieldName.decode(in.readName()), readValue(in));
        }
        in.readEndDocument();
        return object;
    }

    private static JsonNode readValue(BsonReader in) throws UnreadableException {
        return switch (in.getCurrentBsonType()) {
            case DOCUMENT -> readObject(in);
            case ARRAY -> readArray(in);
            case STRING -> NODES.textNode(in.readString());
            case BOOLEAN -> NODES.booleanNode(in.readBoolean());
            case NULL -> {
                in.readNull();
                yield NODES.nullNode();
            }
            case INT32, INT64, DOUBLE, DECIMAL128 -> BsonNumbers.read(in);
            default ->
                throw new UnreadableException(
                        Reason.NOT_AN_EVENT,
                        "field %s is a %s, which no event holds"
                                .formatted(in.getCurrentName(), in.getCurrentBsonType()));
        };
    }

    private static ArrayNode readArray(BsonReader in) throws UnreadableException {
        ArrayNode array = NODES.arrayNode();
        in.readStartArray();
        while (in.readBsonType() != BsonType.END_OF_DOCUMENT) {
            array.add(readValue(in));
        }
        in.readEndArray();
        return array;
    }

    /** Returns the headers to store, without those that repeat other fields of the document. */
    public static Map<String, String> storedHeaders(Map<String, String> headers) {
        Map<String, String> storedHeaders = new TreeMap<>(headers);
        storedHeaders.remove(HeaderNames.CE_ID);
        storedHeaders.remove(HeaderNames.CE_TIME);
        storedHeaders.remove(HeaderNames.CE_SPECVERSION);
        return storedHeaders;
    }
}
