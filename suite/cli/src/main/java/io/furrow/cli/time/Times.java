package io.furrow.cli.time;

import java.time.DateTimeException;
import java.time.Duration;
import java.time.Instant;
import java.time.OffsetDateTime;
import java.time.ZoneId;
import java.time.format.DateTimeFormatter;
import java.time.temporal.ChronoUnit;

import com.fasterxml.jackson.databind.JsonNode;

/** Formats times for people: in ISO 8601 to the second, in the time zone of this computer, with its offset. */
public final class Times {
    private Times() {}

    /** @param time epoch ms */
    public static String of(long time) {
        return of(Instant.ofEpochMilli(time), ZoneId.systemDefault());
    }

    /** @param time epoch ms or ISO 8601; any other text is returned as it is */
    public static String of(JsonNode time) {
        try {
            return of(instant(time), ZoneId.systemDefault());
        } catch (DateTimeException e) {
            return time.asText();
        }
    }

    /** @param time epoch ms or ISO 8601 @throws DateTimeException if it is neither */
    public static Instant instant(JsonNode time) {
        return time.isIntegralNumber()
                ? Instant.ofEpochMilli(time.longValue())
                : OffsetDateTime.parse(time.asText()).toInstant();
    }

    static String of(Instant time, ZoneId zone) {
        return DateTimeFormatter.ISO_OFFSET_DATE_TIME.format(
                time.truncatedTo(ChronoUnit.SECONDS).atZone(zone));
    }

    /** A time with its distance from now. @param time epoch ms */
    public static String ago(long time, Instant now) {
        Duration ago = Duration.between(Instant.ofEpochMilli(time), now);
        return (ago.isNegative() ? "%s (in %s)" : "%s (%s ago)").formatted(of(time), age(ago.abs()));
    }

    /** An age in its greatest unit: {@code 42s}, {@code 5m}, {@code 3h}, {@code 12d}. */
    public static String age(Duration age) {
        if (age.compareTo(Duration.ofMinutes(2)) < 0) {
            return Math.max(0, age.toSeconds()) + "s";
        } else if (age.compareTo(Duration.ofHours(2)) < 0) {
            return age.toMinutes() + "m";
        }
        return age.compareTo(Duration.ofDays(2)) < 0 ? age.toHours() + "h" : age.toDays() + "d";
    }
}
