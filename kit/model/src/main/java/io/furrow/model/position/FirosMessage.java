package io.furrow.model.position;

import java.io.IOException;
import java.util.Arrays;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonToken;

/** Reads the position out of FIROS' text, JSON whose quotes are written {@code %27}, without a tree. */
final class FirosMessage {
    private static final String QUOTE = "%27";

    private final StrictTokens tokens = new StrictTokens();
    private byte[] json = new byte[512];
    private double latitude;
    private double longitude;

    PositionReading read(String escaped) {
        return readTokens(escaped) ? PositionParser.of(latitude, longitude) : PositionParser.ofFiros(escaped);
    }

    /** Whether the text could be read so; where not, something in it is wrong or rare. */
    boolean readTokens(String escaped) {
        latitude = Double.NaN;
        longitude = Double.NaN;
        int length = unescape(escaped);
        if (length < 0) {
            return false;
        }
        try (JsonParser parser = tokens.open(json, length)) {
            return takeMessage(parser);
        } catch (IOException | NumberFormatException e) { // the reader of trees meets it again and says what it is
            return false;
        }
    }

    private boolean takeMessage(JsonParser parser) throws IOException {
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

    /** How many bytes the JSON has; −1 where a character is none of ASCII. */
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
