package io.furrow.model.position;

import java.io.IOException;

import com.fasterxml.jackson.core.JsonFactory;
import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonToken;
import com.fasterxml.jackson.core.StreamReadFeature;

import io.furrow.model.ngsi.NgsiJson;

/**
 * Reads the tokens of JSON documents, as strict as {@link NgsiJson}. A method that returns {@code false} has found
 * invalid or rare input; the tree reader determines which.
 */
final class StrictTokens {
    /** {@link DuplicateNameDetector} finds duplicate names without a set for each object. */
    private static final JsonFactory FACTORY = NgsiJson.mapper()
            .getFactory()
            .rebuild()
            .disable(StreamReadFeature.STRICT_DUPLICATE_DETECTION)
            .enable(StreamReadFeature.USE_FAST_DOUBLE_PARSER)
            .build();

    private final DuplicateNameDetector names = new DuplicateNameDetector();
    private JsonParser parser;
    /**
     * Whether no text of the document can contain a surrogate or be too long, so that unused texts need no decoding.
     */
    private boolean plain;

    /** Opens a document; the caller closes the parser. */
    JsonParser open(byte[] json, int length) throws IOException {
        names.clear();
        plain = length <= NgsiJson.MAX_STRING && isFreeOfSurrogates(json, length);
        parser = FACTORY.createParser(json, 0, length);
        return parser;
    }

    /** Returns the next token; null at the end of the document and at a duplicate name. */
    JsonToken next() throws IOException {
        JsonToken token = parser.nextToken();
        if (token == JsonToken.FIELD_NAME) {
            return names.add(parser.currentName()) ? token : null;
        }
        if (token == JsonToken.START_OBJECT) {
            names.openObject();
        } else if (token == JsonToken.END_OBJECT) {
            names.closeObject();
        }
        return token;
    }

    /** Skips the current value; returns false if it may violate {@code EntityLimits}. */
    boolean skipWithinLimits() throws IOException {
        int depth = 0;
        for (JsonToken token = parser.currentToken(); token != null; token = next()) {
            depth += token.isStructStart() ? 1 : token.isStructEnd() ? -1 : 0;
            boolean within = switch (token) {
                case FIELD_NAME, VALUE_STRING -> isPlainText();
                case VALUE_NUMBER_FLOAT -> isPlainNumber(parser.getDoubleValue());
                case VALUE_NUMBER_INT -> parser.getTextLength() > 0; // throws if it is too long
                default -> true;
            };
            if (!within) {
                return false;
            }
            if (depth == 0) {
                return true;
            }
        }
        return false;
    }

    /**
     * Returns whether the text cannot contain surrogates: in UTF-8 only four-byte sequences are pairs, and only escapes
     * are halves; both are rare.
     */
    private static boolean isFreeOfSurrogates(byte[] json, int length) {
        for (int i = 0; i < length; i++) {
            if (json[i] == '\\' || (json[i] & 0xf8) == 0xf0) {
                return false;
            }
        }
        return true;
    }

    /** Returns whether the current text has no surrogates, which are rare. */
    boolean isPlainText() throws IOException {
        if (plain) {
            return true;
        }
        char[] text = parser.getTextCharacters();
        int end = parser.getTextOffset() + parser.getTextLength();
        for (int i = parser.getTextOffset(); i < end; i++) {
            if (Character.isSurrogate(text[i])) {
                return false;
            }
        }
        return true;
    }

    /** Compares the current text without creating a string. */
    boolean isText(String expected) throws IOException {
        if (parser.getTextLength() != expected.length()) {
            return false;
        }
        char[] text = parser.getTextCharacters();
        int offset = parser.getTextOffset();
        for (int i = 0; i < expected.length(); i++) {
            if (text[offset + i] != expected.charAt(i)) {
                return false;
            }
        }
        return true;
    }

    /** Returns whether the current number, with this double value, has an exponent within the limits. */
    boolean isPlainNumber(double number) throws IOException {
        if (number != 0 && Double.isFinite(number) || parser.currentToken() == JsonToken.VALUE_NUMBER_INT) {
            return true;
        }
        char[] text = parser.getTextCharacters();
        int end = parser.getTextOffset() + parser.getTextLength();
        for (int i = parser.getTextOffset(); i < end; i++) {
            if (text[i] == 'e' || text[i] == 'E') {
                return false;
            }
        }
        return true;
    }
}
