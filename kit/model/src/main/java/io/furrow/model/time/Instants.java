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
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * Parses times of devices: a number since 1970, or its digits; a date and time of ISO 8601 (UTC without an offset, as
 * in NGSI-v2) and similar formats, see {@link OtherTimes}; the start of an ISO 8601 interval. Times before 1970 are
 * rejected.
 *
 * <p>The magnitude of a number determines its unit: from 1e9 to 1e11 it is seconds (2001 to 5138), up to 1e14
 * milliseconds, up to 1e17 microseconds, then nanoseconds; below 1e9 milliseconds.
 */
public final class Instants {
    private static final double MIN_SECONDS = 1e9;
    private static final double MIN_MILLIS = 1e11;
    private static final double MIN_MICROS = 1e14;
    private static final double MIN_NANOS = 1e17;
    private static final double END_OF_NANOS = 1e20;
    private static final int MILLIS_PER_SECOND = 1000;
    private static final int NANOS_PER_MILLI = 1_000_000;

    /** The last second of the year 33658. */
    private static final long LATEST_SECOND = 999_999_999_999L;

    private static final Pattern FRACTION = Pattern.compile("([.,]\\d{1,18})?([eE][+]?\\d{1,2})?");

    private static final DateTimeFormatter ISO = new DateTimeFormatterBuilder()
            .append(DateTimeFormatter.ISO_LOCAL_DATE_TIME)
            .appendPattern("[XXX][XX][X]")
            .toFormatter(Locale.ROOT)
            .withResolverStyle(ResolverStyle.STRICT)
            .withChronology(IsoChronology.INSTANCE);

    private Instants() {}

    /** Returns the instant of a value; empty if it has none. */
    public static Optional<Instant> of(JsonNode value) {
        return value.isTextual()
                ? ofText(value.textValue())
                : ofNumber(value.isNumber() ? value.doubleValue() : Double.NaN);
    }

    /** Returns the instant of a number since 1970; empty if it is NaN, negative or too large. */
    public static Optional<Instant> ofNumber(double number) {
        if (!(number >= 0 && number < END_OF_NANOS)) {
            return Optional.empty();
        }
        double millis = number;
        if (number >= MIN_NANOS) {
            millis = number / NANOS_PER_MILLI;
        } else if (number >= MIN_MICROS) {
            millis = number / MILLIS_PER_SECOND;
        } else if (number >= MIN_SECONDS && number < MIN_MILLIS) {
            millis = number * MILLIS_PER_SECOND;
        }
        return Optional.of(Instant.ofEpochMilli(Math.round(millis)));
    }

    public static Optional<Instant> ofText(String untrimmed) {
        String text = untrimmed.trim();
        if (isNumber(text)) {
            return ofNumber(Double.parseDouble(text.replace(',', '.')));
        }
        int slash = text.indexOf('/');
        String start = slash < 0 ? text : text.substring(0, slash).trim();
        return IsoTime.parse(start)
                .or(() -> anyForm(start))
                .or(() -> OtherTimes.parse(start))
                .flatMap(Instants::sinceEpoch);
    }

    /** Returns the end of an ISO 8601 interval of two times; empty if the text is none. */
    public static Optional<Instant> endOfInterval(String text) {
        int slash = text.indexOf('/');
        return slash < 0 ? Optional.empty() : ofText(text.substring(slash + 1));
    }

    /** Returns whether the text is digits with an optional fraction and exponent and not a date. */
    private static boolean isNumber(String text) {
        int digits = 0;
        while (digits < text.length() && text.charAt(digits) >= '0' && text.charAt(digits) <= '9') {
            digits++;
        }
        boolean isDate = digits == text.length() && (digits == OtherTimes.DATE || digits == OtherTimes.COMPACT);
        return digits > 0 && !isDate && FRACTION.matcher(text.substring(digits)).matches();
    }

    /** Parses a date and time of ISO 8601 with optional seconds and offset; empty if it is invalid. */
    public static Optional<Instant> anyForm(String text) {
        try {
            TemporalAccessor time = ISO.parseBest(text, OffsetDateTime::from, LocalDateTime::from);
            Instant instant = time instanceof OffsetDateTime offset
                    ? offset.toInstant()
                    : ((LocalDateTime) time).toInstant(ZoneOffset.UTC);
            return Optional.of(instant).filter(it -> Math.abs(it.getEpochSecond()) < LATEST_SECOND);
        } catch (DateTimeException e) {
            return Optional.empty();
        }
    }

    private static Optional<Instant> sinceEpoch(Instant instant) {
        return instant.toEpochMilli() >= 0 ? Optional.of(instant) : Optional.empty();
    }
}
