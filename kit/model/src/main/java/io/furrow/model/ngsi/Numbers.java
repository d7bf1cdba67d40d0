package io.furrow.model.ngsi;

import java.util.Optional;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;

/** Reads numbers of devices: JSON numbers, their text, or a FIROS message with one number. */
public final class Numbers {
    private static final Pattern DECIMAL =
            Pattern.compile("[+-]?(\\d{1,40}(\\.\\d{0,40})?|\\.\\d{1,40})([eE][+-]?\\d{1,3})?");

    private Numbers() {}

    /** Returns the value as a finite number; empty for NaN, infinities and other values. */
    public static Optional<Double> finite(JsonNode value) {
        if (value.isNumber()) {
            return Optional.of(value.doubleValue()).filter(Double::isFinite);
        }
        double number = value.isTextual() ? finite(value.textValue()) : Double.NaN;
        return Double.isNaN(number) ? Optional.empty() : Optional.of(number);
    }

    /** Returns the digits of a whole number up to 2^53; empty for others. */
    public static Optional<String> digits(double number) {
        return number == Math.rint(number) && Math.abs(number) < 1L << 53
                ? Optional.of(Long.toString((long) number))
                : Optional.empty();
    }

    /** Returns the finite number of a text; NaN for any other text. */
    public static double finite(String untrimmed) {
        String text = untrimmed.trim();
        double number = DECIMAL.matcher(text).matches()
                ? Double.parseDouble(text)
                : FirosJson.number(text).orElse(Double.NaN);
        return Double.isFinite(number) ? number : Double.NaN;
    }
}
