package io.furrow.analytics.collision.rules;

import java.io.Serializable;
import java.util.Map;
import java.util.TreeMap;

/**
 * Up to which distance two devices are close. A pair of types may have its own threshold; else the greater of both
 * types' thresholds counts, by default the common one.
 *
 * @param meters the common threshold, 0.1 to 100,000
 * @param ofTypes meters by type, or by two types with {@code +} between them
 */
public record Thresholds(double meters, Map<String, Double> ofTypes) implements Serializable {
    private static final String AND = "+";
    /** Below this, the rounding of unit vectors would exceed the guard band of {@code Proximity}. */
    private static final double MIN = 0.1;

    private static final double GREATEST = 100_000;

    public Thresholds {
        requireMetres("the threshold", meters);
        Map<String, Double> sorted = new TreeMap<>();
        ofTypes.forEach((types, threshold) -> {
            requireMetres("the threshold of " + types, threshold);
            if (sorted.put(inOrder(types), threshold) != null) {
                throw new IllegalArgumentException("the threshold of " + types + " is named twice");
            }
        });
        ofTypes = Map.copyOf(sorted);
    }

    /** One threshold for all types. */
    public static Thresholds of(double meters) {
        return new Thresholds(meters, Map.of());
    }

    /** The threshold of a pair of types, in either order. */
    public double between(String type, String other) {
        if (ofTypes.isEmpty()) {
            return meters;
        }
        Double named = ofTypes.get(pair(type, other));
        return named != null ? named : Math.max(of(type), of(other));
    }

    /** The same for equal thresholds in every JVM. */
    @Override
    public String toString() {
        return meters + " " + new TreeMap<>(ofTypes);
    }

    /** The greatest threshold of any pair. */
    public double greatest() {
        return ofTypes.values().stream().reduce(meters, Math::max);
    }

    /** All thresholds multiplied by a factor. */
    Thresholds times(double factor) {
        Map<String, Double> wider = new TreeMap<>(ofTypes);
        wider.replaceAll((types, threshold) -> threshold * factor);
        return new Thresholds(meters * factor, wider);
    }

    private double of(String type) {
        return ofTypes.getOrDefault(type, meters);
    }

    private static String pair(String type, String other) {
        return type.compareTo(other) <= 0 ? type + AND + other : other + AND + type;
    }

    private static String inOrder(String types) {
        int and = types.indexOf(AND);
        String first = and < 0 ? types : types.substring(0, and);
        String second = and < 0 ? null : types.substring(and + AND.length());
        if (first.isBlank() || second != null && second.isBlank()) {
            throw new IllegalArgumentException("'" + types + "' is neither a type nor two types with + between them");
        }
        return second == null ? first : pair(first, second);
    }

    private static void requireMetres(String what, double meters) {
        if (!(meters >= MIN && meters <= GREATEST)) {
            throw new IllegalArgumentException(what + " must be 0.1 to 100000 meters, not " + meters);
        }
    }
}
