package io.furrow.soak.devices;

import java.time.Instant;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.TreeMap;

import io.furrow.model.ngsi.Entity;

/** The averages of fields by their definition: of each window the mean of the devices' medians, the broken device left out. */
final class Averages {
    private static final long WINDOW_MILLIS = 10_000;
    /** From so many devices on one that is broken is told from the others. */
    private static final int VERIFIED = 3;

    private Averages() {}

    /** @return what each field's window says, by field and end, of the windows that lie within this time */
    static Map<String, String> expected(List<ProgramEvent> sent, Map<String, String> fields, long from, long to) {
        Map<String, Map<String, List<Double>>> windows = new TreeMap<>();
        for (ProgramEvent each : sent) {
            String field = fields.get(each.device());
            long start = Math.floorDiv(each.time(), WINDOW_MILLIS) * WINDOW_MILLIS;
            if (field != null && start >= from && start + WINDOW_MILLIS <= to) {
                windows.computeIfAbsent(name(field, start + WINDOW_MILLIS), any -> new TreeMap<>())
                        .computeIfAbsent(each.device(), any -> new ArrayList<>())
                        .add(each.value());
            }
        }
        Map<String, String> averages = new TreeMap<>();
        windows.forEach((name, readings) -> {
            Map<String, Double> votes = new TreeMap<>();
            readings.forEach((device, values) -> votes.put(device, median(values)));
            List<String> broken = votes.entrySet().stream()
                    .filter(vote -> votes.size() >= VERIFIED && vote.getValue() >= Roster.BROKEN)
                    .map(Map.Entry::getKey)
                    .toList();
            double mean = votes.entrySet().stream()
                    .filter(vote -> !broken.contains(vote.getKey()))
                    .mapToDouble(Map.Entry::getValue)
                    .average()
                    .orElseThrow();
            averages.put(name, value(mean, votes.size(), broken));
        });
        return averages;
    }

    /** @return what was found, by field and end; a second one of a window differs from any */
    static Map<String, String> found(List<Entity> results, long from, long to) {
        Map<String, String> averages = new HashMap<>();
        for (Entity each : results) {
            long end = each.number("windowEnd").orElseThrow().longValue();
            if (end - WINDOW_MILLIS >= from && end <= to) {
                List<String> suspects = new ArrayList<>();
                each.value("suspects").orElseThrow().forEach(suspect -> suspects.add(suspect.asText()));
                String value = value(
                        each.number("averageTemperature").orElseThrow(),
                        each.number("devices").orElseThrow().intValue(),
                        suspects);
                averages.merge(name(each.text("field").orElseThrow(), end), value, (one, other) -> one + ", " + other);
            }
        }
        return averages;
    }

    private static String name(String field, long end) {
        return field + " until " + Instant.ofEpochMilli(end);
    }

    private static String value(double mean, int devices, List<String> suspects) {
        return String.format(Locale.ROOT, "%.6f of %d devices, suspect %s", mean, devices, suspects);
    }

    private static double median(List<Double> values) {
        double[] sorted =
                values.stream().mapToDouble(Double::doubleValue).sorted().toArray();
        return (sorted[(sorted.length - 1) / 2] + sorted[sorted.length / 2]) / 2;
    }
}
