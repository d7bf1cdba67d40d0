package io.furrow.model.ngsi;

import java.io.IOException;
import java.util.Set;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonToken;
import com.fasterxml.jackson.databind.DeserializationFeature;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.ObjectReader;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * Reads the desired attributes of a normalized entity in one pass and skips the others without creating objects. It
 * rejects the same input as a reader of the whole entity, so that later readers do not fail.
 */
final class PartialEntityReader {
    /** Reads a value within the entity, which continues behind it. */
    private static final ObjectReader VALUES =
            NgsiJson.mapper().reader().without(DeserializationFeature.FAIL_ON_TRAILING_TOKENS);

    private PartialEntityReader() {}

    static Entity read(byte[] normalized, Set<String> desired) throws UnreadableException {
        NgsiJson.checkUtf8(normalized);
        boolean checkTexts = normalized.length > NgsiJson.MAX_STRING || hasUnicodeEscape(normalized);
        JsonNode excerpt = NgsiJson.understand(() -> {
            try (JsonParser parser = NgsiJson.mapper().createParser(normalized)) {
                return excerpt(parser, desired, checkTexts);
            }
        });
        return NgsiV2Representation.NORMALIZED.read(excerpt);
    }

    /** Returns whether the text has a Unicode escape: in UTF-8 only an escape can be half of a surrogate pair. */
    private static boolean hasUnicodeEscape(byte[] json) {
        for (int i = 1; i < json.length; i++) {
            if (json[i] == 'u' && json[i - 1] == '\\') {
                return true;
            }
        }
        return false;
    }

    private static ObjectNode excerpt(JsonParser parser, Set<String> desired, boolean checkTexts)
            throws IOException, UnreadableException {
        JsonToken first = parser.nextToken();
        if (first != JsonToken.START_OBJECT) {
            throw first == null
                    ? new UnreadableException(Reason.NOT_JSON, "the body is empty")
                    : new UnreadableException(Reason.NOT_AN_ENTITY, "an entity is a JSON object");
        }
        ObjectNode excerpt = NgsiJson.object();
        while (parser.nextToken() == JsonToken.FIELD_NAME) {
            String name = parser.currentName();
            JsonToken value = parser.nextToken();
            if (name.equals("id") || name.equals("type") || desired.contains(name)) {
                excerpt.set(name, VALUES.readTree(parser));
            } else if (value != JsonToken.START_OBJECT || !skip(parser, checkTexts)) {
                throw NgsiV2Representation.noAttribute(name);
            } else if (checkTexts) {
                EntityLimits.checkText(name);
            }
        }
        Reason.NOT_JSON.refuseIf(parser.nextToken() != null, "something follows the entity");
        return excerpt;
    }

    /** Skips the attribute that begins here and returns whether it has a member {@code value}. */
    private static boolean skip(JsonParser parser, boolean checkTexts) throws IOException, UnreadableException {
        boolean hasValue = false;
        for (int depth = 1; depth > 0; ) {
            JsonToken token = parser.nextToken();
            switch (token) {
                case START_OBJECT, START_ARRAY -> depth++;
                case END_OBJECT, END_ARRAY -> depth--;
                case FIELD_NAME ->
                    hasValue |= depth == 1 && parser.currentName().equals("value");
                case VALUE_NUMBER_INT -> parser.getTextLength(); // checks the limit of its length
                case VALUE_NUMBER_FLOAT -> checkNumber(parser);
                default -> {} // texts are checked below, other tokens are always valid
            }
            if (checkTexts && (token == JsonToken.FIELD_NAME || token == JsonToken.VALUE_STRING)) {
                EntityLimits.checkText(parser.getText());
            }
        }
        return hasValue;
    }

    /** Checks a number; it is parsed only if it has an exponent, which is rare. */
    private static void checkNumber(JsonParser parser) throws IOException, UnreadableException {
        char[] text = parser.getTextCharacters();
        int end = parser.getTextOffset() + parser.getTextLength();
        for (int i = parser.getTextOffset(); i < end; i++) {
            if (text[i] == 'e' || text[i] == 'E') {
                EntityLimits.checkExponent(parser.getDecimalValue());
                return;
            }
        }
    }
}
