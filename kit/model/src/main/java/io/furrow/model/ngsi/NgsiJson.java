package io.furrow.model.ngsi;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.util.Arrays;

import com.fasterxml.jackson.core.JsonFactory;
import com.fasterxml.jackson.core.JsonGenerator;
import com.fasterxml.jackson.core.SerializableString;
import com.fasterxml.jackson.core.StreamReadConstraints;
import com.fasterxml.jackson.core.StreamReadFeature;
import com.fasterxml.jackson.core.StreamWriteFeature;
import com.fasterxml.jackson.core.exc.StreamConstraintsException;
import com.fasterxml.jackson.core.io.SerializedString;
import com.fasterxml.jackson.core.util.ByteArrayBuilder;
import com.fasterxml.jackson.databind.DeserializationFeature;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.ObjectMapper;
import com.fasterxml.jackson.databind.ObjectReader;
import com.fasterxml.jackson.databind.cfg.JsonNodeFeature;
import com.fasterxml.jackson.databind.json.JsonMapper;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.text.Utf8;

/**
 * Reads and writes all JSON: strict RFC 8259 (UTF-8, one document, no duplicate names, no NaN), nesting at most {@value
 * #MAX_NESTING}, strings at most 8 MiB, numbers at most 1000 characters, decimal numbers without loss of digits.
 */
public final class NgsiJson {
    public static final int MAX_NESTING = 64;
    public static final int MAX_STRING = 8 * 1024 * 1024;

    private static final byte[] BYTE_ORDER_MARK = {(byte) 0xef, (byte) 0xbb, (byte) 0xbf};
    private static final int TYPICAL_ENTITY = 2048;
    private static final SerializableString TYPE = new SerializedString("type");
    private static final SerializableString VALUE = new SerializedString("value");
    private static final SerializableString METADATA = new SerializedString("metadata");

    private static final ObjectMapper MAPPER = JsonMapper.builder(JsonFactory.builder()
                    .streamReadConstraints(StreamReadConstraints.builder()
                            .maxNestingDepth(MAX_NESTING)
                            .maxStringLength(MAX_STRING)
                            .build())
                    .enable(StreamReadFeature.STRICT_DUPLICATE_DETECTION)
                    .enable(StreamWriteFeature.USE_FAST_DOUBLE_WRITER)
                    // NGSI is UTF-8; Jackson would guess UTF-16 and UTF-32 from the first bytes.
                    .disable(JsonFactory.Feature.CHARSET_DETECTION)
                    .build())
            .enable(DeserializationFeature.FAIL_ON_TRAILING_TOKENS)
            .enable(DeserializationFeature.USE_BIG_DECIMAL_FOR_FLOATS)
            .disable(JsonNodeFeature.STRIP_TRAILING_BIGDECIMAL_ZEROES)
            .build();
    private static final ObjectReader READER = MAPPER.reader();

    private NgsiJson() {}

    /** Returns the mapper, for other JSON than notifications (configuration, REST bodies). */
    public static ObjectMapper mapper() {
        return MAPPER;
    }

    /** Returns a new object without members. */
    public static ObjectNode object() {
        return JsonNodeFactory.instance.objectNode();
    }

    /** Returns a new array without elements. */
    public static ArrayNode array() {
        return JsonNodeFactory.instance.arrayNode();
    }

    /**
     * Reads one JSON document.
     *
     * @throws UnreadableException with {@link Reason#NOT_JSON} or {@link Reason#TOO_DEEP}
     */
    public static JsonNode read(byte[] bytes) throws UnreadableException {
        return read(bytes, READER);
    }

    static JsonNode read(byte[] bytes, ObjectReader reader) throws UnreadableException {
        checkUtf8(bytes);
        checkMark(bytes);
        return understand(() -> {
            JsonNode node = reader.readTree(bytes);
            Reason.NOT_JSON.refuseIf(node == null || node.isMissingNode(), "the body is empty");
            return node;
        });
    }

    /** Reads the document of a file, which may begin with a byte order mark, as editors on Windows write it. */
    public static JsonNode readFile(byte[] bytes) throws UnreadableException {
        return read(hasMark(bytes) ? Arrays.copyOfRange(bytes, BYTE_ORDER_MARK.length, bytes.length) : bytes);
    }

    private static boolean hasMark(byte[] bytes) {
        int length = BYTE_ORDER_MARK.length;
        return bytes.length >= length && Arrays.equals(bytes, 0, length, BYTE_ORDER_MARK, 0, length);
    }

    private static void checkMark(byte[] bytes) throws UnreadableException {
        Reason.NOT_JSON.refuseIf(hasMark(bytes), "the text begins with a byte order mark (EF BB BF); send it without");
    }

    /** Checks the whole text, because Jackson's decoder is too lenient and checks only values that are read. */
    static void checkUtf8(byte[] bytes) throws UnreadableException {
        int wrong = Utf8.firstWrong(bytes);
        if (wrong >= 0) {
            throw new UnreadableException(Reason.NOT_JSON, "byte " + wrong + " of the body is not UTF-8");
        }
    }

    /** Reads JSON that was written by this class or read before. */
    public static <T> T own(Reading<T> reading) {
        try {
            return reading.read();
        } catch (IOException | UnreadableException e) {
            throw new IllegalStateException("JSON of this program cannot be read", e);
        }
    }

    /** Reads input with Jackson. */
    public interface Reading<T> {
        T read() throws IOException, UnreadableException;
    }

    /** Reads input and converts Jackson's failures. */
    static <T> T understand(Reading<T> reading) throws UnreadableException {
        try {
            return reading.read();
        } catch (StreamConstraintsException e) {
            throw new UnreadableException(Reason.TOO_DEEP, JsonProblem.of(e), e);
        } catch (NumberFormatException e) { // thrown for exponents beyond that of a BigDecimal
            throw new UnreadableException(Reason.TOO_DEEP, "a number's exponent is out of range", e);
        } catch (IOException e) {
            throw new UnreadableException(Reason.NOT_JSON, JsonProblem.of(e), e);
        }
    }

    /** Returns the entity as UTF-8 JSON without white space. */
    static byte[] write(EntityBuilder entity) {
        ByteArrayBuilder bytes = new ByteArrayBuilder(TYPICAL_ENTITY);
        try (JsonGenerator json = MAPPER.createGenerator(bytes)) {
            json.writeStartObject();
            json.writeStringField("id", entity.id());
            json.writeFieldName(TYPE);
            json.writeString(entity.type());
            for (EntityBuilder.Attribute attribute : entity.attributes()) {
                json.writeObjectFieldStart(attribute.name());
                json.writeFieldName(TYPE);
                json.writeString(attribute.type());
                json.writeFieldName(VALUE);
                write(attribute.value(), json);
                json.writeFieldName(METADATA);
                json.writeStartObject();
                json.writeEndObject();
                json.writeEndObject();
            }
            json.writeEndObject();
        } catch (IOException e) {
            throw new UncheckedIOException("an entity could not be written", e);
        }
        return bytes.toByteArray();
    }

    private static void write(JsonNode value, JsonGenerator json) throws IOException {
        if (value.isTextual()) {
            json.writeString(value.textValue());
        } else if (value.isLong()) {
            json.writeNumber(value.longValue());
        } else if (value.isDouble()) {
            json.writeNumber(value.doubleValue());
        } else {
            json.writeTree(value);
        }
    }

    /** Returns the node as UTF-8 JSON without white space. */
    public static byte[] write(JsonNode node) {
        try {
            return MAPPER.writeValueAsBytes(node);
        } catch (IOException e) {
            throw new UncheckedIOException("a JSON tree could not be written", e);
        }
    }
}
