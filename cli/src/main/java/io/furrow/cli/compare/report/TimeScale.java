package io.furrow.cli.compare.report;

import java.time.Instant;
import java.time.ZoneOffset;
import java.time.format.DateTimeFormatter;
import java.util.List;

import io.furrow.cli.compare.Comparison;
import io.furrow.cli.compare.Span;

/**
 * Where a time is in a picture.
 *
 * @param from the earliest time, epoch ms
 * @param to the latest
 * @param left where the earliest is, in pixels
 * @param right where the latest is
 */
record TimeScale(long from, long to, int left, int right) {
    private static final DateTimeFormatter CLOCK =
            DateTimeFormatter.ofPattern("HH:mm:ss").withZone(ZoneOffset.UTC);
    private static final DateTimeFormatter DAY =
            DateTimeFormatter.ofPattern("MMM d HH:mm").withZone(ZoneOffset.UTC);
    private static final long DAY_MILLIS = 24 * 3600 * 1000L;

    /** Wide enough for all results of both sides. */
    static TimeScale of(Comparison comparison, int left, int right) {
        List<Span> all = comparison.matches().values().stream()
                .flatMap(List::stream)
                .flatMap(match -> java.util.stream.Stream.of(match.either(), match.b() == null ? match.a() : match.b()))
                .toList();
        long from = all.stream().mapToLong(comparison.range()::start).min().orElse(0);
        long to = all.stream()
                .mapToLong(span ->
                        span.isOpen() ? span.start() : comparison.range().end(span))
                .max()
                .orElse(1);
        return new TimeScale(from, Math.max(to, from + 1), left, right);
    }

    double x(long time) {
        return left + (double) (Math.max(from, Math.min(to, time)) - from) / (to - from) * (right - left);
    }

    /** The time at a place, in UTC. */
    String label(double x) {
        long time = from + Math.round((x - left) / (right - left) * (to - from));
        return (to - from > DAY_MILLIS ? DAY : CLOCK).format(Instant.ofEpochMilli(time));
    }
}
