package io.furrow.launcher.status;

import java.time.Instant;
import java.time.ZoneId;
import java.time.format.DateTimeFormatter;
import java.util.Locale;

import io.furrow.model.ngsi.Entity;

/** Result entities as one line of text each. */
final class ResultLines {
    private static final DateTimeFormatter CLOCK =
            DateTimeFormatter.ofPattern("HH:mm:ss").withZone(ZoneId.systemDefault());

    private ResultLines() {}

    /** For instance {@code field-1   21.3 °C   4 devices, robust, suspect urn:…:4   12:00:10}. */
    static String average(Entity entity) {
        String suspects = entity.value("suspects")
                .filter(list -> !list.isEmpty())
                .map(list -> ", suspect " + list.get(0).asText() + (list.size() > 1 ? " …" : ""))
                .orElse("");
        return String.format(
                Locale.ROOT,
                "%-12s %6.2f °C   %d devices, %s%s   window to %s",
                entity.text("field").orElse("?"),
                entity.number("averageTemperature").orElse(Double.NaN),
                entity.number("devices").orElse(0.0).intValue(),
                entity.text("quality").orElse("?"),
                suspects,
                clock(entity, "windowEnd"));
    }

    /** For instance {@code 12:00:10 started  4.1 m  urn:…:Robot:1 – urn:…:Robot:2}. */
    static String collision(Entity entity) {
        return String.format(
                Locale.ROOT,
                "%s %-8s %5.2f m   %s – %s",
                clock(entity, "time"),
                entity.text("phase").orElse("?"),
                entity.number("distance").orElse(Double.NaN),
                entity.text("Device1_ID").orElse("?"),
                entity.text("Device2_ID").orElse("?"));
    }

    private static String clock(Entity entity, String attribute) {
        return entity.number(attribute)
                .map(millis -> CLOCK.format(Instant.ofEpochMilli(millis.longValue())))
                .orElse("?");
    }
}
