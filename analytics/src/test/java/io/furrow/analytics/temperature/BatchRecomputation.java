package io.furrow.analytics.temperature;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;

import io.furrow.analytics.temperature.RandomCase.Arrival;
import io.furrow.analytics.temperature.RandomCase.Rectangle;

/**
 * The definition, written down a second time.
 *
 * @param results "field start end" → the attributes
 * @param late "field event-id" of each reading that came after its last window had closed
 */
record BatchRecomputation(Map<String, Map<String, Object>> results, List<String> late) {
    static BatchRecomputation of(RandomCase random) {
        Map<String, TreeMap<String, List<Double>>> windows = new TreeMap<>();
        List<String> late = new ArrayList<>();
        Set<Object> seen = new HashSet<>();
        long watermark = Long.MIN_VALUE;
        for (Arrival arrival : random.readings()) {
            String eventId = arrival.record().headers().get("ce_id");
            if (seen.add(eventId)) {
                for (Rectangle field : random.fields()) {
                    if (contains(field, arrival) && !taken(random, field, arrival, watermark, windows)) {
                        late.add(field.id() + " " + eventId);
                    }
                }
            }
            watermark = Math.max(watermark, arrival.time() - random.bound() - 1);
        }
        Map<String, Map<String, Object>> results = new HashMap<>();
        windows.forEach((window, devices) -> results.put(window, result(devices, random.floor())));
        return new BatchRecomputation(results, late);
    }

    private static boolean contains(Rectangle field, Arrival arrival) {
        return field.west() <= arrival.longitude()
                && arrival.longitude() <= field.east()
                && field.south() <= arrival.latitude()
                && arrival.latitude() <= field.north();
    }

    /** Adds the reading to every window that is still open; whether there was one. */
    private static boolean taken(
            RandomCase random,
            Rectangle field,
            Arrival arrival,
            long watermark,
            Map<String, TreeMap<String, List<Double>>> windows) {
        boolean taken = false;
        long start = arrival.time() - arrival.time() % random.slide();
        for (; start > arrival.time() - random.window(); start -= random.slide()) {
            long end = start + random.window();
            if (watermark < end - 1 + random.lateness()) {
                taken = true;
                windows.computeIfAbsent(field.id() + " " + start + " " + end, unused -> new TreeMap<>())
                        .computeIfAbsent(arrival.device(), unused -> new ArrayList<>())
                        .add(arrival.value());
            }
        }
        return taken;
    }

    private static Map<String, Object> result(TreeMap<String, List<Double>> devices, double floor) {
        TreeMap<String, Double> votes = new TreeMap<>();
        devices.forEach((device, values) -> votes.put(device, middle(values)));
        double centre = middle(new ArrayList<>(votes.values()));
        double mad = middle(
                votes.values().stream().map(vote -> Math.abs(vote - centre)).toList());
        List<String> suspects = new ArrayList<>();
        List<Double> kept = new ArrayList<>();
        votes.forEach((device, vote) -> {
            boolean far = Math.abs(vote - centre) > 3 * 1.4826 * Math.max(mad, floor);
            if (votes.size() >= 3 && far) {
                suspects.add('"' + device + '"');
            } else {
                kept.add(vote);
            }
        });
        return Map.of(
                "averageTemperature",
                average(kept),
                "plainMean",
                average(new ArrayList<>(votes.values())),
                "spread",
                1.4826 * mad,
                "devices",
                votes.size(),
                "suspects",
                "[" + String.join(",", suspects) + "]",
                "quality",
                votes.size() < 3 ? "unverified" : "robust");
    }

    private static double average(List<Double> values) {
        return values.stream().mapToDouble(value -> value).average().orElseThrow();
    }

    private static double middle(List<Double> values) {
        List<Double> sorted = values.stream().sorted().toList();
        int n = sorted.size();
        return (sorted.get((n - 1) / 2) + sorted.get(n / 2)) / 2;
    }
}
