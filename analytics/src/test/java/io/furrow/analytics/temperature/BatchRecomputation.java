package io.furrow.analytics.temperature;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.stream.IntStream;

import io.furrow.analytics.temperature.RandomCases.Arrival;
import io.furrow.analytics.temperature.RandomCases.Change;

/** The definition, written down a second time: lists instead of streams, and nothing of the job's own code. */
final class BatchRecomputation {
    /** What fell into a window of a field. */
    private static final class Window {
        final TreeMap<String, List<Double>> devices = new TreeMap<>();
        Change newest;
    }

    private final RandomCases random;
    private final Map<String, TreeMap<Long, Change>> known = new TreeMap<>();
    /** Field → start of the window. */
    private final TreeMap<String, TreeMap<Long, Window>> windows = new TreeMap<>();

    private final List<String> late = new ArrayList<>();
    private long watermark = Long.MIN_VALUE;

    private BatchRecomputation(RandomCases random) {
        this.random = random;
    }

    static BatchRecomputation of(RandomCases random) {
        BatchRecomputation batch = new BatchRecomputation(random);
        List<Change> changes = new ArrayList<>(random.changes());
        Set<Object> seen = new HashSet<>();
        for (int i = 0; i < random.readings().size(); i++) {
            while (!changes.isEmpty() && changes.get(0).before() <= i) {
                batch.change(changes.remove(0));
            }
            Arrival arrival = random.readings().get(i);
            if (seen.add(arrival.record().headers().get("ce_id"))) {
                batch.read(arrival);
            }
            batch.watermark = Math.max(batch.watermark, arrival.time() - random.bound() - 1);
        }
        return batch;
    }

    private void change(Change change) {
        TreeMap<Long, Change> versions = known.computeIfAbsent(change.field(), field -> new TreeMap<>());
        if (change.taken()) {
            versions.remove(change.validFrom());
        } else {
            versions.put(change.validFrom(), change);
        }
    }

    private void read(Arrival arrival) {
        for (String field : known.keySet()) {
            Change version = at(field, arrival.time());
            if (version != null && version.shape().covers(arrival.longitude(), arrival.latitude())) {
                if (!isTaken(version, arrival)) {
                    late.add(field + " " + arrival.record().headers().get("ce_id"));
                }
            }
        }
    }

    /** Null if there is no such field then. */
    private Change at(String field, long time) {
        Change last = null;
        for (Change version : known.get(field).values()) {
            last = version.validFrom() <= time ? version : last;
        }
        return last == null || last.shape() == null ? null : last;
    }

    /** Adds the reading to every window that is still open; whether there was one. */
    private boolean isTaken(Change version, Arrival arrival) {
        boolean taken = false;
        long slide = random.setting().slide();
        long start = arrival.time() - arrival.time() % slide;
        for (; start > arrival.time() - random.setting().window(); start -= slide) {
            if (watermark < lastInstant(start) + random.setting().lateness()) {
                taken = true;
                Window window = windows.computeIfAbsent(version.field(), field -> new TreeMap<>())
                        .computeIfAbsent(start, unused -> new Window());
                window.devices
                        .computeIfAbsent(arrival.device(), unused -> new ArrayList<>())
                        .add(arrival.value());
                if (window.newest == null || window.newest.validFrom() < version.validFrom()) {
                    window.newest = version;
                }
            }
        }
        return taken;
    }

    private long lastInstant(long start) {
        return start + random.setting().window() - 1;
    }

    /** "Field event-id" of each reading that came after its last window had closed. */
    List<String> late() {
        return late;
    }

    /** "Field start end" → the attributes. */
    Map<String, Map<String, Object>> results() {
        Map<String, Map<String, Object>> results = new HashMap<>();
        windows.forEach((field, ofField) -> {
            ofField.forEach((start, window) -> results.put(name(field, start), result(window)));
        });
        return results;
    }

    private String name(String field, long start) {
        return field + " " + start + " " + (lastInstant(start) + 1);
    }

    private Map<String, Object> result(Window window) {
        double floor = random.setting().floor();
        TreeMap<String, Double> votes = new TreeMap<>();
        window.devices.forEach((device, values) -> votes.put(device, middle(values)));
        double centre = middle(new ArrayList<>(votes.values()));
        double mad = middle(
                votes.values().stream().map(vote -> Math.abs(vote - centre)).toList());
        List<String> outward = votes.keySet().stream()
                .sorted(Comparator.comparing((String device) -> Math.abs(votes.get(device) - centre))
                        .thenComparing(votes::get))
                .toList();
        List<Double> offsets =
                outward.stream().map(device -> votes.get(device) - centre).toList();
        int sound = IntStream.range(offsets.size() / 2 + 1, offsets.size())
                .filter(k -> isTooFar(offsets.get(k), offsets.subList(0, k), offsets.size(), floor))
                .findFirst()
                .orElse(offsets.size());
        List<Double> kept = outward.subList(0, sound).stream().map(votes::get).toList();
        List<String> suspects = outward.subList(sound, outward.size()).stream()
                .sorted()
                .map(device -> '"' + device + '"')
                .toList();
        Map<String, Object> result = new HashMap<>();
        result.put("averageTemperature", average(kept));
        result.put("plainMean", average(new ArrayList<>(votes.values())));
        result.put("spread", 1.4826 * mad);
        result.put("devices", votes.size());
        result.put("suspects", "[" + String.join(",", suspects) + "]");
        result.put("quality", votes.size() < 3 ? "unverified" : "robust");
        result.put("Domain", window.newest.domain());
        return result;
    }

    /** Whether a vote is far from those that are nearer to the middle, of this many in all. */
    private static boolean isTooFar(double vote, List<Double> nearer, int all, double floor) {
        double k = nearer.size();
        double squares = nearer.stream()
                .mapToDouble(each -> Math.pow(each - average(nearer), 2))
                .sum();
        double spread = (all - 1) / k * Math.sqrt(squares / (k - 1)) * (k == 2 ? 4.3 : 1);
        double sigma = Math.max(floor / Math.sqrt(2), spread) * Math.sqrt((k + 1) / k);
        return Math.abs(vote - average(nearer)) > Math.sqrt(2 * Math.log(22 * all)) * sigma;
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
