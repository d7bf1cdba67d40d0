package io.furrow.model.time;

import java.time.DateTimeException;
import java.time.Instant;
import java.time.LocalDateTime;
import java.time.OffsetDateTime;
import java.time.ZoneOffset;
import java.time.chrono.IsoChronology;
import java.time.format.DateTimeFormatter;
import java.time.format.DateTimeFormatterBuilder;
import java.time.format.ResolverStyle;
import java.time.temporal.TemporalAccessor;
import java.util.Locale;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * Instants as devices send them: epoch milliseconds, a date and time of ISO 8601 (without offset it is UTC, as NGSI-v2 has it),
 * the start of an ISO 8601 interval, or the digits of epoch milliseconds. Never before 1970.
 */
public final class Instants {
    /** The year 33658: 15 digits of milliseconds. What is later is no time. */
    private static final double LATEST_MILLIS = 999_999_999_999_999d;

    private static final int MAX_DIGITS = 15;

    private static final DateTimeFormatter ISO = new DateTimeFormatterBuilder()
            .append(DateTimeFormatter.ISO_LOCAL_DATE_TIME)
            .appendPattern("[XXX][XX][X]")
            .toFormatter(Locale.ROOT)
            .withResolverStyle(ResolverStyle.STRICT)
            .withChronology(IsoChronology.INSTANCE);

    private Instants() {}

    /** The instant that a value names; empty if it names none. */
    public static Optional<Instant> of(JsonNode value) {
        return value.isTextual()
                ? ofText(value.textValue())
                : ofMillis(value.isNumber() ? value.doubleValue() : Double.NaN);
    }

    public static Optional<Instant> ofMillis(double millis) {
        return Math.abs(millis) <= LATEST_MILLIS ? sinceEpoch(Instant.ofEpochMilli((long) millis)) : Optional.empty();
    }

    public static Optional<Instant> ofText(String untrimmed) {
        String text = untrimmed.trim();
        if (isDigits(text)) {
            return Optional.of(Instant.ofEpochMilli(Long.parseLong(text)));
        }
        int slash = text.indexOf('/');
        String start = slash < 0 ? text : text.substring(0, slash);
        return IsoTime.parse(start).or(() -> anyForm(start)).flatMap(Instants::sinceEpoch);
    }

    private static boolean isDigits(String text) {
        boolean digits = !text.isEmpty() && text.length() <= MAX_DIGITS;
        for (int i = 0; digits && i < text.length(); i++) {
            digits = text.charAt(i) >= '0' && text.charAt(i) <= '9';
        }
        return digits;
    }

    /** A date and time of ISO 8601, seconds and offset optional; empty if it is none. */
    public static Optional<Instant> anyForm(String text) {
        try {
            TemporalAccessor time = ISO.parseBest(text, OffsetDateTime::from, LocalDateTime::from);
            Instant instant = time instanceof OffsetDateTime offset
                    ? offset.toInstant()
                    : ((LocalDateTime) time).toInstant(ZoneOffset.UTC);
            return Optional.of(instant).filter(it -> Math.abs(it.getEpochSecond()) < LATEST_MILLIS / 1000);
        } catch (DateTimeException e) {
            return Optional.empty();
        }
    }

    private static Optional<Instant> sinceEpoch(Instant instant) {
        return instant.toEpochMilli() >= 0 ? Optional.of(instant) : Optional.empty();
    }
}
