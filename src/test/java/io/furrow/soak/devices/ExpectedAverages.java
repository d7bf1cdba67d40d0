package io.furrow.soak.devices;

import java.time.Instant;
import java.util.ArrayList;
import java.util.Collection;
import java.util.HashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.Function;

import io.furrow.model.ngsi.Entity;

/**
 * The averages of fields by their definition: per window the mean of the devices' medians, without the broken device.
 *
 * @param windowMillis length of a window
 */
public record ExpectedAverages(long windowMillis) {
    /** From this number of devices on, a broken one can be detected. */
    private static final int MIN_DEVICES = 3;

    /**
     * The expected averages by field and end, of the windows within the period.
     *
     * @param fields the field in which a device measured; null for none
     */
    public Map<String, String> expected(
            List<ProgramEvent> sent, Function<ProgramEvent, String> fields, long from, long to) {
        Map<String, Map<String, List<Double>>> windows = new TreeMap<>();
        for (ProgramEvent each : sent) {
            String field = fields.apply(each);
            long start = Math.floorDiv(each.time(), windowMillis) * windowMillis;
            if (field != null && start >= from && start + windowMillis <= to) {
                windows.computeIfAbsent(name(field, start + windowMillis), any -> new TreeMap<>())
                        .computeIfAbsent(each.device(), any -> new ArrayList<>())
                        .add(each.value());
            }
        }
        Map<String, String> averages = new TreeMap<>();
        windows.forEach((name, readings) -> {
            Map<String, Double> votes = new TreeMap<>();
            readings.forEach((device, values) -> votes.put(device, median(values)));
            List<String> broken = votes.entrySet().stream()
                    .filter(vote -> votes.size() >= MIN_DEVICES && vote.getValue() >= ProgramPlan.BROKEN)
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

    /** @return the actual averages by field and end; a second result of a window makes its text differ */
    public Map<String, String> found(Collection<Entity> results, long from, long to) {
        Map<String, String> averages = new HashMap<>();
        for (Entity each : results) {
            long end = each.number("windowEnd").orElseThrow().longValue();
            if (end - windowMillis >= from && end <= to) {
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
