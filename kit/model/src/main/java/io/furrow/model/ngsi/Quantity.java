package io.furrow.model.ngsi;

import java.util.Map;
import java.util.Optional;
import java.util.function.DoubleUnaryOperator;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * What a number measures, and the unit in which it is read. Metadata {@code unitCode}, a code of UN/CEFACT Recommendation 20, decides in
 * which it was reported; a number without it is in the unit in which it is read. The dashboard's page reads numbers by the same rules, and
 * its tests the same table of cases.
 */
public enum Quantity {
    /** m/s; none in another unit. */
    SPEED(
            Map.of(
                    "MTS", number -> number,
                    "KMH", number -> number / 3.6,
                    "HM", number -> number * 0.44704,
                    "KNT", number -> number * 1852 / 3600),
            number -> Double.NaN),
    /** Degrees clockwise from north; none in another unit. */
    HEADING(Map.of("DD", number -> number, "C81", Math::toDegrees), number -> Double.NaN),
    /** °C; what an average is made of may be no temperature, and is in its own unit then. */
    TEMPERATURE(Map.of("FAH", number -> (number - 32) / 1.8, "KEL", number -> number - 273.15), number -> number),
    /** A part of a whole, 0 to 1; none in another unit. */
    SHARE(Map.of("C62", number -> number, "P1", number -> number / 100), number -> Double.NaN);

    private final Map<String, DoubleUnaryOperator> units;
    private final DoubleUnaryOperator other;

    Quantity(Map<String, DoubleUnaryOperator> units, DoubleUnaryOperator other) {
        this.units = units;
        this.other = other;
    }

    /** @param unitCode empty if none was reported @return NaN for a number in an unknown unit */
    public double read(double number, String unitCode) {
        return unitCode.isEmpty() ? number : units.getOrDefault(unitCode, other).applyAsDouble(number);
    }

    /** The number of an attribute as this quantity; empty if it is missing, no finite number, or in an unknown unit. */
    public Optional<Double> of(Entity entity, String attribute) {
        return entity.number(attribute)
                .map(number -> read(number, unitOf(entity, attribute)))
                .filter(Double::isFinite);
    }

    /** Metadata {@code unitCode}, else {@code unit}; empty if there is none. */
    public static String unitOf(Entity entity, String attribute) {
        JsonNode metadata = entity.json().path(attribute).path("metadata");
        JsonNode code = metadata.path("unitCode").path("value");
        return code.isTextual() && !code.textValue().isEmpty()
                ? code.textValue()
                : metadata.path("unit").path("value").asText("");
    }
}
