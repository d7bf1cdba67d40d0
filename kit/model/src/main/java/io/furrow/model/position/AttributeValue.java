package io.furrow.model.position;

import java.io.IOException;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonToken;

import io.furrow.model.ngsi.Numbers;

/** Reads the value of a desired attribute if it is a text, a number or a truth value; each entity overwrites it. */
class AttributeValue {
    private enum Kind {
        /** The attribute is missing or null. */
        ABSENT,
        TEXT,
        NUMBER,
        TRUE,
        FALSE,
        OTHER
    }

    private Kind kind = Kind.ABSENT;
    private String text = "";
    private double number;
    private String unitCode = "";
    private String unit = "";

    public void clear() {
        kind = Kind.ABSENT;
        unitCode = "";
        unit = "";
    }

    /** Reads the current value; returns false if it is invalid or rare. */
    boolean read(StrictTokens tokens, JsonParser parser) throws IOException {
        switch (parser.currentToken()) {
            case VALUE_NULL -> kind = Kind.ABSENT;
            case VALUE_STRING -> {
                if (!tokens.isPlainText()) {
                    return false;
                }
                kind = Kind.TEXT;
                // Reuses the previous text if it is the same, as for a device's mission.
                text = tokens.isText(text) ? text : parser.getText();
            }
            case VALUE_NUMBER_INT, VALUE_NUMBER_FLOAT -> {
                kind = Kind.NUMBER;
                number = number(parser);
                return tokens.isPlainNumber(number);
            }
            case VALUE_TRUE, VALUE_FALSE -> {
                kind = parser.currentToken() == JsonToken.VALUE_TRUE ? Kind.TRUE : Kind.FALSE;
                return readOther(tokens, parser);
            }
            default -> {
                kind = Kind.OTHER;
                return readOther(tokens, parser);
            }
        }
        return true;
    }

    /** Reads the unit from the current metadata; returns false if they are invalid or rare. */
    boolean readMetadata(StrictTokens tokens, JsonParser parser) throws IOException {
        if (parser.currentToken() != JsonToken.START_OBJECT) {
            return tokens.skipWithinLimits();
        }
        while (tokens.next() == JsonToken.FIELD_NAME) {
            boolean isCode = tokens.isText("unitCode");
            boolean isUnit = isCode || tokens.isText("unit");
            boolean isRead = tokens.isPlainText()
                    && (isUnit && tokens.next() == JsonToken.START_OBJECT
                            ? readUnit(isCode, tokens, parser)
                            : skipValue(tokens, parser));
            if (!isRead) {
                return false;
            }
        }
        return parser.currentToken() == JsonToken.END_OBJECT;
    }

    private static boolean skipValue(StrictTokens tokens, JsonParser parser) throws IOException {
        if (parser.currentToken() == JsonToken.FIELD_NAME) {
            tokens.next();
        }
        return tokens.skipWithinLimits();
    }

    private boolean readUnit(boolean isCode, StrictTokens tokens, JsonParser parser) throws IOException {
        while (tokens.next() == JsonToken.FIELD_NAME) {
            boolean isValue = tokens.isText("value");
            if (!tokens.isPlainText()) {
                return false;
            }
            if (tokens.next() == JsonToken.VALUE_STRING && isValue && isCode) {
                unitCode = tokens.isText(unitCode) ? unitCode : parser.getText();
            } else if (isValue && !isCode && parser.currentToken().isScalarValue()) {
                unit = parser.currentToken() == JsonToken.VALUE_NULL ? "" : parser.getText();
            }
            if (!tokens.skipWithinLimits()) {
                return false;
            }
        }
        return parser.currentToken() == JsonToken.END_OBJECT;
    }

    /** Returns metadata {@code unitCode}, else {@code unit}; empty if there is none. */
    String unit() {
        return unitCode.isEmpty() ? unit : unitCode;
    }

    public boolean readOther(StrictTokens tokens, JsonParser parser) throws IOException {
        return tokens.skipWithinLimits();
    }

    /** Returns the current number, with negative zero as zero, as decimal numbers have it. */
    static double number(JsonParser parser) throws IOException {
        return parser.getDoubleValue() + 0.0;
    }

    /** Returns the current finite number or that of a text; NaN for other values. */
    static double numberOrNaN(JsonParser parser) throws IOException {
        JsonToken token = parser.currentToken();
        if (token.isNumeric()) {
            double number = number(parser);
            return Double.isFinite(number) ? number : Double.NaN;
        }
        return token == JsonToken.VALUE_STRING ? Numbers.finite(parser.getText()) : Double.NaN;
    }

    boolean isPresent() {
        return kind != Kind.ABSENT;
    }

    /** Returns the truth value; null for other values. */
    Boolean truthOrNull() {
        return kind == Kind.TRUE ? Boolean.TRUE : kind == Kind.FALSE ? Boolean.FALSE : null;
    }

    /** Returns the text; null for other values. */
    String textOrNull() {
        return kind == Kind.TEXT ? text : null;
    }

    /** Returns the finite number, also if it was sent as text; otherwise NaN. */
    double finite() {
        return switch (kind) {
            case NUMBER -> Double.isFinite(number) ? number : Double.NaN;
            case TEXT -> Numbers.finite(text);
            default -> Double.NaN;
        };
    }
}
