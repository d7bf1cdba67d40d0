package io.furrow.model.position;

import java.io.IOException;

import com.fasterxml.jackson.core.JsonFactory;
import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonToken;
import com.fasterxml.jackson.core.StreamReadFeature;

import io.furrow.model.ngsi.NgsiJson;

/**
 * The tokens of one JSON document after the other, as strict as {@link NgsiJson}. A method that answers {@code false} has met
 * something that is wrong or rare; the reader of trees finds out which.
 */
final class StrictTokens {
    /** Names that come twice are found by {@link DuplicateNameDetector}, which makes no set for each object. */
    private static final JsonFactory FACTORY = NgsiJson.mapper()
            .getFactory()
            .rebuild()
            .disable(StreamReadFeature.STRICT_DUPLICATE_DETECTION)
            .enable(StreamReadFeature.USE_FAST_DOUBLE_PARSER)
            .build();

    private final DuplicateNameDetector names = new DuplicateNameDetector();
    private JsonParser parser;
    /** Whether no text of the document can hold a surrogate or be too long: then those that nobody wants stay undecoded. */
    private boolean plain;

    /** Begins a document; the parser belongs to the caller, who closes it. */
    JsonParser open(byte[] json, int length) throws IOException {
        names.clear();
        plain = length <= NgsiJson.MAX_STRING && isFreeOfSurrogates(json, length);
        parser = FACTORY.createParser(json, 0, length);
        return parser;
    }

    /** The next token; null at the end of the document and where a name comes twice. */
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

    /** Skips the value that the parser stands at, and answers whether it certainly keeps to {@code EntityLimits}. */
    boolean skipWithinLimits() throws IOException {
        int depth = 0;
        for (JsonToken token = parser.currentToken(); token != null; token = next()) {
            depth += token.isStructStart() ? 1 : token.isStructEnd() ? -1 : 0;
            boolean within = switch (token) {
                case FIELD_NAME, VALUE_STRING -> isPlainText();
                case VALUE_NUMBER_FLOAT -> isPlainNumber(parser.getDoubleValue());
                case VALUE_NUMBER_INT -> parser.getTextLength() > 0; // thrown where it is too long
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

    /** In UTF-8 only four bytes make a pair of them, and only an escape a half; both are rare. */
    private static boolean isFreeOfSurrogates(byte[] json, int length) {
        for (int i = 0; i < length; i++) {
            if (json[i] == '\\' || (json[i] & 0xf8) == 0xf0) {
                return false;
            }
        }
        return true;
    }

    /** Whether the text holds no surrogate, neither half of a pair nor a pair, which is rare. */
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

    /** Whether the text that the parser stands at is this one; makes no text to find out. */
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

    /** Whether the number that was read as this double cannot have an exponent that is too great. */
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
