package io.furrow.launcher.status;

import java.time.Instant;
import java.time.ZoneId;
import java.time.format.DateTimeFormatter;
import java.util.Locale;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.result.CollisionResult;
import io.furrow.model.result.FieldResult;
import io.furrow.model.text.Counts;

/** Formats result entities as one line of text each. */
final class ResultLines {
    private static final DateTimeFormatter CLOCK =
            DateTimeFormatter.ofPattern("HH:mm:ss").withZone(ZoneId.systemDefault());

    private ResultLines() {}

    /** For instance {@code field-1   21.3 °C   4 devices, robust, suspect urn:…:4   12:00:10}. */
    static String average(Entity entity) {
        String suspects = entity.value(FieldResult.SUSPECTS)
                .filter(list -> !list.isEmpty())
                .map(list -> ", suspect " + list.get(0).asText() + (list.size() > 1 ? " …" : ""))
                .orElse("");
        return String.format(
                Locale.ROOT,
                "%-12s %6.2f °C   %s, %s%s   window to %s",
                entity.text(FieldResult.FIELD).orElse("?"),
                entity.number(FieldResult.AVERAGE_TEMPERATURE).orElse(Double.NaN),
                Counts.of(entity.number(FieldResult.DEVICES).orElse(0.0).longValue(), "device"),
                entity.text(FieldResult.QUALITY).orElse("?"),
                suspects,
                clock(entity, FieldResult.WINDOW_END));
    }

    /** For instance {@code 12:00:10 started  4.1 m  urn:…:Robot:1 – urn:…:Robot:2}. */
    static String collision(Entity entity) {
        return String.format(
                Locale.ROOT,
                "%s %-8s %5.2f m   %s – %s",
                clock(entity, CollisionResult.TIME),
                entity.text(CollisionResult.PHASE).orElse("?"),
                entity.number(CollisionResult.DISTANCE).orElse(Double.NaN),
                entity.text(CollisionResult.FIRST.id()).orElse("?"),
                entity.text(CollisionResult.SECOND.id()).orElse("?"));
    }

    private static String clock(Entity entity, String attribute) {
        return entity.number(attribute)
                .map(millis -> CLOCK.format(Instant.ofEpochMilli(millis.longValue())))
                .orElse("?");
    }
}
