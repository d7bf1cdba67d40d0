package io.furrow.model.position;

import java.io.IOException;
import java.util.Arrays;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonToken;

/** Reads the position from FIROS' text, JSON with quotes escaped as {@code %27}, without a tree. */
final class FirosMessage {
    private static final String QUOTE = "%27";

    private final StrictTokens tokens = new StrictTokens();
    private byte[] json = new byte[512];
    private double latitude;
    private double longitude;

    PositionReading read(String escaped) {
        return readTokens(escaped) ? PositionParser.of(latitude, longitude) : PositionParser.ofFiros(escaped);
    }

    /** Reads a text without a tree; returns false if it is invalid or rare. */
    boolean readTokens(String escaped) {
        latitude = Double.NaN;
        longitude = Double.NaN;
        int length = unescape(escaped);
        if (length < 0) {
            return false;
        }
        try (JsonParser parser = tokens.open(json, length)) {
            return readMessage(parser);
        } catch (IOException | NumberFormatException e) { // the tree reader reports the cause
            return false;
        }
    }

    private boolean readMessage(JsonParser parser) throws IOException {
        if (tokens.next() != JsonToken.START_OBJECT) {
            return false;
        }
        while (tokens.next() == JsonToken.FIELD_NAME) {
            String name = parser.currentName();
            tokens.next();
            if (name.equals("latitude")) {
                latitude = AttributeValue.numberOrNaN(parser);
            } else if (name.equals("longitude")) {
                longitude = AttributeValue.numberOrNaN(parser);
            }
            if (!tokens.skipWithinLimits()) {
                return false;
            }
        }
        return parser.currentToken() == JsonToken.END_OBJECT && tokens.next() == null;
    }

    /** Unescapes the text; returns the number of bytes, −1 if a character is not ASCII. */
    private int unescape(String escaped) {
        if (json.length < escaped.length()) {
            json = Arrays.copyOf(json, Math.max(escaped.length(), 2 * json.length));
        }
        int length = 0;
        for (int i = 0; i < escaped.length(); i++) {
            char character = escaped.charAt(i);
            if (character >= 0x80) {
                return -1;
            }
            boolean quote = character == '%' && escaped.startsWith(QUOTE, i);
            json[length++] = (byte) (quote ? '"' : character);
            i += quote ? QUOTE.length() - 1 : 0;
        }
        return length;
    }
}
