package io.furrow.model.position;

import java.io.IOException;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonToken;

/** Reads the value of {@code location}: the text of a geo:point, or an object that may be a GeoJSON Point. */
final class LocationValue extends AttributeValue {
    private boolean typeIsPoint;
    private int coordinates;
    private double longitude;
    private double latitude;

    @Override
    public void clear() {
        super.clear();
        typeIsPoint = false;
        coordinates = 0;
    }

    @Override
    public boolean readOther(StrictTokens tokens, JsonParser parser) throws IOException {
        if (parser.currentToken() != JsonToken.START_OBJECT) {
            return tokens.skipWithinLimits();
        }
        while (tokens.next() == JsonToken.FIELD_NAME) {
            String name = parser.currentName();
            boolean isRead = tokens.isPlainText() && readMember(name, tokens, parser);
            if (!isRead) {
                return false;
            }
        }
        return parser.currentToken() == JsonToken.END_OBJECT;
    }

    private boolean readMember(String name, StrictTokens tokens, JsonParser parser) throws IOException {
        JsonToken value = tokens.next();
        if (name.equals("coordinates") && value == JsonToken.START_ARRAY) {
            while (tokens.next() != JsonToken.END_ARRAY) {
                if (!readCoordinate(tokens, parser)) {
                    return false;
                }
            }
            return true;
        }
        if (name.equals("type")) {
            typeIsPoint = value == JsonToken.VALUE_STRING && tokens.isText("Point");
        }
        return tokens.skipWithinLimits();
    }

    private boolean readCoordinate(StrictTokens tokens, JsonParser parser) throws IOException {
        double coordinate = numberOrNaN(parser);
        if (coordinates == 0) {
            longitude = coordinate;
        } else if (coordinates == 1) {
            latitude = coordinate;
        }
        coordinates++;
        return tokens.skipWithinLimits();
    }

    /** Returns whether it is a blank text. */
    boolean isBlank() {
        String text = textOrNull();
        return text != null && text.isBlank();
    }

    PositionReading position() {
        String text = textOrNull();
        if (text != null) {
            return PositionParser.ofGeoPoint(text);
        }
        return typeIsPoint && coordinates >= 2 ? PositionParser.of(latitude, longitude) : PositionParser.NO_POINT;
    }
}
