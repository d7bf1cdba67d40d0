package io.furrow.model.position;

import java.io.IOException;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonToken;

import io.furrow.model.ngsi.Numbers;

/** The value of one wanted attribute as far as it is a text or a number; overwritten by each entity. */
class AttributeValue {
    private enum Kind {
        /** No such attribute, or its value is null. */
        ABSENT,
        TEXT,
        NUMBER,
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

    /** Takes the value that the parser stands at; false if it is wrong or rare. */
    boolean take(StrictTokens tokens, JsonParser parser) throws IOException {
        switch (parser.currentToken()) {
            case VALUE_NULL -> kind = Kind.ABSENT;
            case VALUE_STRING -> {
                if (!tokens.isPlainText()) {
                    return false;
                }
                kind = Kind.TEXT;
                // The mission of a device is the same from report to report: then no new text is made.
                text = tokens.isText(text) ? text : parser.getText();
            }
            case VALUE_NUMBER_INT, VALUE_NUMBER_FLOAT -> {
                kind = Kind.NUMBER;
                number = number(parser);
                return tokens.isPlainNumber(number);
            }
            default -> {
                kind = Kind.OTHER;
                return takeOther(tokens, parser);
            }
        }
        return true;
    }

    /** Takes the unit from the metadata that the parser stands at; false if they are wrong or rare. */
    boolean takeMetadata(StrictTokens tokens, JsonParser parser) throws IOException {
        if (parser.currentToken() != JsonToken.START_OBJECT) {
            return tokens.skipWithinLimits();
        }
        while (tokens.next() == JsonToken.FIELD_NAME) {
            boolean isCode = tokens.isText("unitCode");
            boolean isUnit = isCode || tokens.isText("unit");
            boolean taken = tokens.isPlainText()
                    && (isUnit && tokens.next() == JsonToken.START_OBJECT
                            ? takeUnit(isCode, tokens, parser)
                            : skipValue(tokens, parser));
            if (!taken) {
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

    private boolean takeUnit(boolean isCode, StrictTokens tokens, JsonParser parser) throws IOException {
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

    /** Metadata {@code unitCode}, else {@code unit}; empty if there is none. */
    String unit() {
        return unitCode.isEmpty() ? unit : unitCode;
    }

    public boolean takeOther(StrictTokens tokens, JsonParser parser) throws IOException {
        return tokens.skipWithinLimits();
    }

    /** The number that the parser stands at; no negative zero, which a decimal number does not know. */
    static double number(JsonParser parser) throws IOException {
        return parser.getDoubleValue() + 0.0;
    }

    /** The finite number at which the parser stands, or that its text names; NaN for everything else. */
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

    /** The text as it is; null for everything else. */
    String textOrNull() {
        return kind == Kind.TEXT ? text : null;
    }

    /** The finite number, also where a device sent it as text; else NaN. */
    double finite() {
        return switch (kind) {
            case NUMBER -> Double.isFinite(number) ? number : Double.NaN;
            case TEXT -> Numbers.finite(text);
            default -> Double.NaN;
        };
    }
}
