package io.furrow.simulators.signal;

import java.time.Duration;
import java.time.Instant;
import java.util.OptionalDouble;
import java.util.random.RandomGenerator;

/** What can be wrong with a sensor for a time; outside that time it is sound. */
public sealed interface Fault {
    Span during();

    /** What the faulty sensor shows at a time within {@link #during()}. */
    OptionalDouble distort(Signal sound, Instant time);

    /** The signal of a sensor that has this fault. */
    default Signal on(Signal sound) {
        return time -> during().holds(time) ? distort(sound, time) : sound.at(time);
    }

    /**
     * Shows the same value again and again.
     *
     * @param value null for what it showed when the fault began
     */
    record Stuck(Span during, Double value) implements Fault {
        @Override
        public OptionalDouble distort(Signal sound, Instant time) {
            return value == null ? sound.at(during.from()) : OptionalDouble.of(value);
        }
    }

    /**
     * Moves away from the truth.
     *
     * @param perHour by how much in an hour, in the unit of the sensor
     */
    record Drift(Span during, double perHour) implements Fault {
        @Override
        public OptionalDouble distort(Signal sound, Instant time) {
            double hours = Duration.between(during.from(), time).toMillis() / 3.6e6;
            return sound.plus(at -> OptionalDouble.of(perHour * hours)).at(time);
        }
    }

    /**
     * Is off by {@code height}, up or down, now and then.
     *
     * @param share of the readings that are, 0 to 1
     */
    record Spikes(Span during, double share, double height, long seed) implements Fault {
        public Spikes {
            if (!(share >= 0 && share <= 1)) {
                throw new IllegalArgumentException("the share of spikes is 0 to 1, not " + share);
            }
        }

        @Override
        public OptionalDouble distort(Signal sound, Instant time) {
            RandomGenerator draw = Draw.of(seed, time.toEpochMilli());
            if (draw.nextDouble() >= share) {
                return sound.at(time);
            }
            double spike = draw.nextBoolean() ? height : -height;
            return sound.plus(at -> OptionalDouble.of(spike)).at(time);
        }
    }

    /** Says nothing. */
    record Silent(Span during) implements Fault {
        @Override
        public OptionalDouble distort(Signal sound, Instant time) {
            return OptionalDouble.empty();
        }
    }
}
