package io.furrow.launcher.status;

import java.util.HashMap;
import java.util.Map;

/** Records per second of each topic, from totals read one after the other. */
final class Rates {
    private Map<String, Long> previous = Map.of();
    private long previousNanos;

    /** Of the time since the call before; 0 for what is seen the first time. */
    Map<String, Double> next(Map<String, Long> totals, long nowNanos) {
        Map<String, Double> rates = new HashMap<>();
        double seconds = Math.max(1e-3, (nowNanos - previousNanos) / 1e9);
        totals.forEach((topic, total) -> {
            long before = previous.getOrDefault(topic, total);
            rates.put(topic, (total - before) / seconds);
        });
        previous = Map.copyOf(totals);
        previousNanos = nowNanos;
        return rates;
    }
}
