package io.furrow.analytics.presence;

import java.io.Serializable;
import java.time.Instant;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.stream.Collectors;

import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.record.TopicRecord;

import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * A version of a field of rectangles, to be asked without geometry. Border counts.
 *
 * @param parts apart from each other; empty if the field ends
 * @param hole in the first part, its border belongs to the field; null for none
 */
record Plot(String id, long validFrom, List<Box> parts, Box hole) implements Serializable {
    /** Degrees. */
    record Box(double west, double south, double east, double north) implements Serializable {
        private boolean covers(double longitude, double latitude) {
            return west <= longitude && longitude <= east && south <= latitude && latitude <= north;
        }

        private boolean surrounds(double longitude, double latitude) {
            return west < longitude && longitude < east && south < latitude && latitude < north;
        }

        private String ring() {
            return String.format(
                    Locale.ROOT,
                    "[[%1$s,%2$s],[%3$s,%2$s],[%3$s,%4$s],[%1$s,%4$s],[%1$s,%2$s]]",
                    west,
                    south,
                    east,
                    north);
        }
    }

    boolean covers(PositionFix fix) {
        return parts.stream().anyMatch(part -> part.covers(fix.longitude(), fix.latitude()))
                && (hole == null || !hole.surrounds(fix.longitude(), fix.latitude()));
    }

    TopicRecord record(long offset) {
        String time = Instant.ofEpochMilli(validFrom).toString();
        String polygons = parts.stream()
                .map(part -> "[" + part.ring() + (hole == null || part != parts.get(0) ? "" : "," + hole.ring()) + "]")
                .collect(Collectors.joining(","));
        String geometry = parts.isEmpty() ? "null" : "{\"type\":\"MultiPolygon\",\"coordinates\":[" + polygons + "]}";
        String value = "{\"type\":\"Feature\",\"id\":\"%s\",\"geometry\":%s,\"properties\":{\"validFrom\":\"%s\"}}"
                .formatted(id, geometry, time);
        return new TopicRecord("service.fields", 0, offset, validFrom, bytes(id + "@" + time), bytes(value), Map.of());
    }

    private static byte[] bytes(String text) {
        return text.getBytes(UTF_8);
    }
}
