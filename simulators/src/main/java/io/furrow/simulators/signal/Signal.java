package io.furrow.simulators.signal;

import java.time.Instant;
import java.util.OptionalDouble;
import java.util.function.DoubleUnaryOperator;

/** What a sensor shows at an instant, empty where it says nothing; a pure function, so that any time may be asked, in any order. */
@FunctionalInterface
public interface Signal {
    OptionalDouble at(Instant time);

    /** The same to so many decimals, as an instrument shows it. */
    default Signal rounded(int decimals) {
        double scale = Math.pow(10, decimals);
        return time -> map(at(time), value -> Math.round(value * scale) / scale);
    }

    /** The same, never below or above the ends of the instrument's range. */
    default Signal within(double lowest, double highest) {
        return time -> map(at(time), value -> Math.min(highest, Math.max(lowest, value)));
    }

    /** The sum of both; empty where one says nothing. */
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
