package io.furrow.model.ngsi;

import java.util.Locale;
import java.util.Map;
import java.util.Optional;
import java.util.function.DoubleUnaryOperator;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * A quantity and the unit in which it is read. Metadata {@code unitCode}, a code of UN/CEFACT Recommendation 20, names
 * the reported unit, as does a common spelling such as {@code km/h}; a number without it already has the unit of the
 * quantity. The dashboard's page follows the same rules, and its tests use the same table of cases.
 */
public enum Quantity {
    /** Speed in m/s; unknown units are rejected. */
    SPEED(
            Map.of(
                    "MTS", number -> number,
                    "KMH", number -> number / 3.6,
                    "HM", number -> number * 0.44704,
                    "KNT", number -> number * 1852 / 3600),
            number -> Double.NaN),
    /** Degrees clockwise from north; unknown units are rejected. */
    HEADING(Map.of("DD", number -> number, "C81", Math::toDegrees), number -> Double.NaN),
    /** Temperature in °C; numbers in unknown units are unchanged, because averages also cover other quantities. */
    TEMPERATURE(Map.of("FAH", number -> (number - 32) / 1.8, "KEL", number -> number - 273.15), number -> number),
    /** A fraction, 0 to 1; unknown units are rejected. */
    SHARE(Map.of("C62", number -> number, "P1", number -> number / 100), number -> Double.NaN),
    /** Length in meters; unknown units are rejected. */
    LENGTH(
            Map.of(
                    "MTR", number -> number,
                    "CMT", number -> number / 100,
                    "MMT", number -> number / 1000,
                    "FOT", number -> number * 0.3048,
                    "INH", number -> number * 0.0254),
            number -> Double.NaN);

    /** Codes by spellings in lower case. */
    private static final Map<String, String> SPELLINGS = Map.ofEntries(
            Map.entry("m/s", "MTS"),
            Map.entry("km/h", "KMH"),
            Map.entry("mph", "HM"),
            Map.entry("kph", "KMH"),
            Map.entry("kn", "KNT"),
            Map.entry("kt", "KNT"),
            Map.entry("kts", "KNT"),
            Map.entry("knots", "KNT"),
            Map.entry("°", "DD"),
            Map.entry("deg", "DD"),
            Map.entry("degree", "DD"),
            Map.entry("degrees", "DD"),
            Map.entry("rad", "C81"),
            Map.entry("c", "CEL"),
            Map.entry("℃", "CEL"),
            Map.entry("celsius", "CEL"),
            Map.entry("f", "FAH"),
            Map.entry("℉", "FAH"),
            Map.entry("fahrenheit", "FAH"),
            Map.entry("k", "KEL"),
            Map.entry("kelvin", "KEL"),
            Map.entry("%", "P1"),
            Map.entry("percent", "P1"),
            Map.entry("m", "MTR"),
            Map.entry("meter", "MTR"),
            Map.entry("meters", "MTR"),
            Map.entry("metre", "MTR"),
            Map.entry("metres", "MTR"),
            Map.entry("cm", "CMT"),
            Map.entry("mm", "MMT"),
            Map.entry("ft", "FOT"),
            Map.entry("feet", "FOT"),
            Map.entry("in", "INH"));

    /** Spellings such as {@code °C}, {@code degF}, {@code degrees Celsius}, and QUDT's {@code …/unit/DEG_F}. */
    private static final Pattern DEGREES = Pattern.compile("(?:.*[/:])?(?:[°º]|deg(?:rees?)?)[ _]?([cfk])[a-z]*");

    private final Map<String, DoubleUnaryOperator> units;
    private final DoubleUnaryOperator other;

    Quantity(Map<String, DoubleUnaryOperator> units, DoubleUnaryOperator other) {
        this.units = units;
        this.other = other;
    }

    /**
     * Converts a number.
     *
     * @param unit a code or a spelling; empty if none was reported
     * @return NaN for a number in an unknown unit
     */
    public double read(double number, String unit) {
        String code = unit.isEmpty() ? unit : codeOf(unit);
        return code.isEmpty() ? number : units.getOrDefault(code, other).applyAsDouble(number);
    }

    private static String codeOf(String unit) {
        String trimmed = unit.trim();
        String name = trimmed.toLowerCase(Locale.ROOT);
        Matcher degrees = DEGREES.matcher(name);
        return SPELLINGS.getOrDefault(degrees.matches() ? degrees.group(1) : name, trimmed.toUpperCase(Locale.ROOT));
    }

    /** Reads an attribute as this quantity; empty if it is missing, not a finite number, or in an unknown unit. */
    public Optional<Double> of(Entity entity, String attribute) {
        return entity.number(attribute)
                .map(number -> read(number, unitOf(entity, attribute)))
                .filter(Double::isFinite);
    }

    /** Returns metadata {@code unitCode}, else {@code unit}; empty if there is none. */
    public static String unitOf(Entity entity, String attribute) {
        JsonNode metadata = entity.json().path(attribute).path("metadata");
        JsonNode code = metadata.path("unitCode").path("value");
        return code.isTextual() && !code.textValue().isEmpty()
                ? code.textValue()
                : metadata.path("unit").path("value").asText("");
    }
}
