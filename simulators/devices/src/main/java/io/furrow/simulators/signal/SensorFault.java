package io.furrow.simulators.signal;

import java.time.Duration;
import java.time.Instant;
import java.util.OptionalDouble;
import java.util.random.RandomGenerator;

/** A fault of a sensor for a period; outside it the sensor is sound. */
public sealed interface SensorFault {
    TimeWindow during();

    /** The reading of the faulty sensor at a time within {@link #during()}. */
    OptionalDouble distort(Signal sound, Instant time);

    /** The signal of a sensor that has this fault. */
    default Signal on(Signal sound) {
        return time -> during().holds(time) ? distort(sound, time) : sound.at(time);
    }

    /**
     * Repeats the same value.
     *
     * @param value null for the reading at the start of the fault
     */
    record Stuck(TimeWindow during, Double value) implements SensorFault {
        @Override
        public OptionalDouble distort(Signal sound, Instant time) {
            return value == null ? sound.at(during.from()) : OptionalDouble.of(value);
        }
    }

    /**
     * Drifts away from the truth.
     *
     * @param perHour change in an hour, in the unit of the sensor
     */
    record Drift(TimeWindow during, double perHour) implements SensorFault {
        @Override
        public OptionalDouble distort(Signal sound, Instant time) {
            double hours = Duration.between(during.from(), time).toMillis() / 3.6e6;
            return sound.plus(at -> OptionalDouble.of(perHour * hours)).at(time);
        }
    }

    /**
     * Is off by {@code height}, up or down, at random.
     *
     * @param share of the readings affected, 0 to 1
     */
    record Spikes(TimeWindow during, double share, double height, long seed) implements SensorFault {
        public Spikes {
            if (!(share >= 0 && share <= 1)) {
                throw new IllegalArgumentException("the share of spikes is 0 to 1, not " + share);
            }
        }

        @Override
        public OptionalDouble distort(Signal sound, Instant time) {
            RandomGenerator draw = RandomStream.of(seed, time.toEpochMilli());
            if (draw.nextDouble() >= share) {
                return sound.at(time);
            }
            double spike = draw.nextBoolean() ? height : -height;
            return sound.plus(at -> OptionalDouble.of(spike)).at(time);
        }
    }

    /** Shows no readings. */
    record Silent(TimeWindow during) implements SensorFault {
        @Override
        public OptionalDouble distort(Signal sound, Instant time) {
            return OptionalDouble.empty();
        }
    }
}
