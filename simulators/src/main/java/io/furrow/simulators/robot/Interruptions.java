package io.furrow.simulators.robot;

import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.random.RandomGenerator;
import java.util.stream.LongStream;

import io.furrow.simulators.signal.Draw;
import io.furrow.simulators.signal.Span;

/**
 * Things that turn up on a way by chance and go away again: one within each {@code every}, at a time and a place of the way
 * that depend on the seed only.
 *
 * @param stay how long each stays
 * @param radius metres
 */
public record Interruptions(Duration every, Duration stay, double radius, long seed) {
    public Interruptions {
        if (every.toMillis() < 1 || stay.toMillis() < 1 || !(radius >= 0)) {
            throw new IllegalArgumentException(
                    "obstacles need a distance in time and a stay of at least 1 ms and a radius from 0 on, not %s, %s and %s"
                            .formatted(every, stay, radius));
        }
    }

    /** Those there at any time after one instant, up to and including another. */
    List<Obstacle> between(Way way, Instant after, Instant upTo) {
        long first = Math.floorDiv(after.minus(stay).toEpochMilli(), every.toMillis());
        long last = Math.floorDiv(upTo.toEpochMilli(), every.toMillis());
        return LongStream.rangeClosed(first, last)
                .mapToObj(number -> number(way, number))
                .filter(obstacle -> obstacle.during().meets(after, upTo))
                .toList();
    }

    private Obstacle number(Way way, long number) {
        RandomGenerator draw = Draw.of(seed, number);
        Instant from = Instant.ofEpochMilli(number * every.toMillis() + draw.nextLong(every.toMillis()));
        return new Obstacle(way.at(draw.nextDouble() * way.lap()).place(), radius, new Span(from, from.plus(stay)));
    }
}
