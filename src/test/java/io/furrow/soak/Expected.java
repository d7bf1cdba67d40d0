package io.furrow.soak;

import java.time.Instant;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.position.Position;
import io.furrow.model.position.PositionReading;

/**
 * Computes the expected results of the jobs from the events on {@code data.raw}, by their definitions and without their
 * code.
 */
final class Expected {
    private static final long ONGOING_EVERY_MILLIS = 1_000;
    private static final double EARTH_RADIUS_METERS = 6_371_000;

    private final TreeMap<Long, Entity> events = new TreeMap<>();

    /** @param events with distinct event times */
    Expected(List<Entity> events) {
        events.forEach(event -> this.events.put(time(event), event));
        if (this.events.size() != events.size()) {
            throw new IllegalArgumentException("two events share an event time or none was read");
        }
    }

    long lastTime() {
        return events.lastKey();
    }

    /** The number of each event. */
    List<Result> numbers() {
        return events.values().stream().map(Expected::numbered).toList();
    }

    static Result numbered(Entity event) {
        return new Result("number " + event.number("Number").orElseThrow().longValue(), event.id(), time(event));
    }

    /** The windows of a field: the mean of the medians of the thermometers in it. */
    List<Result> windows(String field, List<String> thermometers, long windowMillis) {
        List<Result> results = new ArrayList<>();
        long first = Math.floorDiv(events.firstKey(), windowMillis) * windowMillis;
        for (long start = first; start <= lastTime(); start += windowMillis) {
            long end = start + windowMillis;
            var inside = events.subMap(start, end).values();
            double[] votes = thermometers.stream()
                    .map(id -> inside.stream()
                            .filter(event -> event.id().equals(id))
                            .toList())
                    .filter(readings -> !readings.isEmpty())
                    .mapToDouble(Expected::median)
                    .toArray();
            if (votes.length > 0) {
                results.add(window(
                        field, end, java.util.Arrays.stream(votes).average().orElseThrow(), votes.length));
            }
        }
        return results;
    }

    static Result window(String field, long end, double average, long devices) {
        String value = String.format(Locale.ROOT, "%.6f of %d devices", average, devices);
        return new Result(field + " until " + Instant.ofEpochMilli(end), value, end);
    }

    private static double median(List<Entity> readings) {
        double[] values = readings.stream()
                .mapToDouble(reading -> reading.number("Temperature").orElseThrow())
                .sorted()
                .toArray();
        return (values[(values.length - 1) / 2] + values[values.length / 2]) / 2;
    }

    /**
     * The encounters of the two robots, by the distance of their latest positions at each report; the value of an end
     * is the last distance at which they were close.
     *
     * @param threshold maximum distance at which they are close, in meters
     */
    List<Result> encounters(double threshold) {
        List<Result> results = new ArrayList<>();
        Position first = null;
        Position second = null;
        boolean close = false;
        double lastClose = 0;
        long reported = 0;
        for (Entity event : events.values()) {
            first = event.id().equals(SoakFarm.FIRST_ROBOT) ? position(event) : first;
            second = event.id().equals(SoakFarm.SECOND_ROBOT) ? position(event) : second;
            if (!event.type().equals("Robot") || first == null || second == null) {
                continue;
            }
            double distance = meters(first, second);
            boolean now = distance <= threshold;
            if (now != close || now && time(event) - reported >= ONGOING_EVERY_MILLIS) {
                String phase = now ? close ? "ongoing" : "started" : "ended";
                results.add(encounter(phase, time(event), now ? distance : lastClose));
                reported = time(event);
            }
            close = now;
            lastClose = distance;
        }
        return results;
    }

    /** The first report of each device enters the fields in which it stands. */
    List<Result> entries(Map<String, List<String>> fieldsOf) {
        List<Result> results = new ArrayList<>();
        Set<String> seen = new HashSet<>();
        for (Entity event : events.values()) {
            if (seen.add(event.id())) {
                fieldsOf.get(event.id())
                        .forEach(field -> results.add(passage("entered", event.id(), field, time(event))));
            }
        }
        return results;
    }

    static Result passage(String phase, String device, String field, long time) {
        return new Result(
                device + " " + phase + " " + field, Instant.ofEpochMilli(time).toString(), time);
    }

    static Result encounter(String phase, long time, double distance) {
        String value = String.format(Locale.ROOT, "%.3f m", distance);
        return new Result(phase + " at " + Instant.ofEpochMilli(time), value, time);
    }

    private static long time(Entity event) {
        return event.number("Time").orElseThrow().longValue();
    }

    private static Position position(Entity event) {
        return ((PositionReading.Located) PositionReading.of(event)).position();
    }

    /** Haversine formula. */
    private static double meters(Position a, Position b) {
        double latitudes = Math.sin(Math.toRadians(b.latitude() - a.latitude()) / 2);
        double longitudes = Math.sin(Math.toRadians(b.longitude() - a.longitude()) / 2);
        double cosines = Math.cos(Math.toRadians(a.latitude())) * Math.cos(Math.toRadians(b.latitude()));
        double chord = latitudes * latitudes + cosines * longitudes * longitudes;
        return 2 * EARTH_RADIUS_METERS * Math.asin(Math.sqrt(chord));
    }
}
