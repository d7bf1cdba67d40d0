package io.furrow.launcher.status;

import java.time.Duration;
import java.util.ArrayDeque;
import java.util.Deque;
import java.util.HashMap;
import java.util.Map;

/** Records per second of each topic within the last ten seconds, computed from successive totals. */
final class Rates {
    private static final long WINDOW_NANOS = Duration.ofSeconds(10).toNanos();

    private final Deque<Sample> samples = new ArrayDeque<>();

    private record Sample(long nanos, Map<String, Long> totals) {}

    /** 0 for a new topic. */
    Map<String, Double> next(Map<String, Long> totals, long nowNanos) {
        samples.removeIf(sample -> sample != samples.peekLast() && nowNanos - sample.nanos() > WINDOW_NANOS);
        samples.addLast(new Sample(nowNanos, Map.copyOf(totals)));
        Map<String, Double> rates = new HashMap<>();
        totals.forEach((topic, total) -> samples.stream()
                .filter(sample -> sample.totals().containsKey(topic))
                .findFirst()
                .ifPresent(first -> rates.put(
                        topic,
                        (total - first.totals().get(topic)) / Math.max(1e-3, (nowNanos - first.nanos()) / 1e9))));
        return rates;
    }
}
