package io.furrow.soak.devices;

import java.time.Instant;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;

import io.furrow.model.ngsi.Entity;

/**
 * The encounters of moving devices by their definition: while the newest positions of two devices are within five
 * meters and not older than 30 seconds.
 */
public final class ExpectedEncounters {
    private static final double THRESHOLD_METERS = 5;
    private static final long TIME_TO_LIVE_MILLIS = 30_000;
    private static final double EARTH_RADIUS_METERS = 6_371_000;

    private ExpectedEncounters() {}

    /** @param sent positions in the order of their times @return encounters that begin and end within the period */
    public static Set<String> expected(List<ProgramEvent> sent, long from, long to) {
        Map<String, ProgramEvent> last = new HashMap<>();
        Map<String, Open> open = new HashMap<>();
        Set<String> encounters = new TreeSet<>();
        for (ProgramEvent each : sent) {
            expire(open, each.time(), from, encounters);
            last.values().removeIf(other -> other.time() + TIME_TO_LIVE_MILLIS <= each.time());
            last.put(each.device(), each);
            for (ProgramEvent other : last.values()) {
                if (other.device().equals(each.device())) {
                    continue;
                }
                String pair = ProgramPlan.pair(each.device(), other.device());
                if (meters(each, other) <= THRESHOLD_METERS) {
                    Open existing = open.get(pair);
                    long start = existing == null ? each.time() : existing.start();
                    open.put(pair, new Open(start, other.time() + TIME_TO_LIVE_MILLIS));
                } else {
                    Open ended = open.remove(pair);
                    if (ended != null && ended.start() >= from && each.time() <= to) {
                        encounters.add(name(pair, ended.start(), each.time()));
                    }
                }
            }
        }
        expire(open, to, from, encounters);
        return encounters;
    }

    /** @param until when the older of the two positions expires */
    private record Open(long start, long until) {}

    private static void expire(Map<String, Open> open, long time, long from, Set<String> encounters) {
        open.forEach((pair, each) -> {
            if (each.until() <= time && each.start() >= from) {
                encounters.add(name(pair, each.start(), each.until()));
            }
        });
        open.values().removeIf(each -> each.until() <= time);
    }

    /** @return encounters that began and ended within the period */
    public static Set<String> found(List<Entity> results, long from, long to) {
        Set<String> encounters = new TreeSet<>();
        for (Entity each : results) {
            long start = number(each, "startTime");
            long end = number(each, "time");
            if (each.text("phase").orElseThrow().equals("ended") && start >= from && end <= to) {
                encounters.add(name(pair(each), start, end));
            }
        }
        return encounters;
    }

    /** All pairs that met at any time. */
    static List<String> pairs(List<Entity> results) {
        return new ArrayList<>(
                new TreeSet<>(results.stream().map(ExpectedEncounters::pair).toList()));
    }

    private static String pair(Entity result) {
        return ProgramPlan.pair(
                result.text("Device1_ID").orElseThrow(),
                result.text("Device2_ID").orElseThrow());
    }

    private static long number(Entity result, String attribute) {
        return result.number(attribute).orElseThrow().longValue();
    }

    private static String name(String pair, long start, long end) {
        return "%s from %s to %s".formatted(pair, Instant.ofEpochMilli(start), Instant.ofEpochMilli(end));
    }

    /** Haversine formula. */
    private static double meters(ProgramEvent a, ProgramEvent b) {
        double latitudes = Math.sin(Math.toRadians(b.latitude() - a.latitude()) / 2);
        double longitudes = Math.sin(Math.toRadians(b.longitude() - a.longitude()) / 2);
        double cosines = Math.cos(Math.toRadians(a.latitude())) * Math.cos(Math.toRadians(b.latitude()));
        double chord = latitudes * latitudes + cosines * longitudes * longitudes;
        return 2 * EARTH_RADIUS_METERS * Math.asin(Math.sqrt(chord));
    }
}
