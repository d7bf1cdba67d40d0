package io.furrow.simulators.signal;

import java.time.Instant;
import java.util.OptionalDouble;
import java.util.function.DoubleUnaryOperator;

/** The reading of a sensor at an instant, empty if it is silent; a pure function of time. */
@FunctionalInterface
public interface Signal {
    OptionalDouble at(Instant time);

    /** Rounds to this many decimals. */
    default Signal rounded(int decimals) {
        double scale = Math.pow(10, decimals);
        return time -> map(at(time), value -> Math.round(value * scale) / scale);
    }

    /** Clamps to the range of the instrument. */
    default Signal within(double lowest, double highest) {
        return time -> map(at(time), value -> Math.min(highest, Math.max(lowest, value)));
    }

    /** The sum of both; empty if one is silent. */
    default Signal plus(Signal other) {
        return time -> {
            OptionalDouble addend = other.at(time);
            return addend.isEmpty() ? addend : map(at(time), value -> value + addend.getAsDouble());
        };
    }

    private static OptionalDouble map(OptionalDouble value, DoubleUnaryOperator change) {
        return value.isEmpty() ? value : OptionalDouble.of(change.applyAsDouble(value.getAsDouble()));
    }
}
