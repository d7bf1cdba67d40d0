package io.furrow.cli.time;

import java.time.DateTimeException;
import java.time.Duration;
import java.time.Instant;
import java.time.LocalDate;
import java.time.LocalDateTime;
import java.time.LocalTime;
import java.time.OffsetDateTime;
import java.time.ZonedDateTime;
import java.time.chrono.IsoChronology;
import java.time.format.DateTimeFormatter;
import java.time.format.DateTimeFormatterBuilder;
import java.time.format.ResolverStyle;
import java.time.temporal.TemporalAccessor;
import java.util.Locale;

import picocli.CommandLine.ITypeConverter;
import picocli.CommandLine.TypeConversionException;

import io.furrow.flink.job.DurationConverter;

/**
 * Converts times as people write them: dates and times of ISO 8601, without an offset in the time zone of this
 * computer; {@code now}; a
 * duration ago, {@code -5m}, or ahead, {@code +2h}; a time of day, the last one of it; epoch ms.
 */
public class TimeConverter implements ITypeConverter<Instant> {
    /** For descriptions of options. */
    public static final String FORMS = "as 2026-05-01T08:00:00, 06:00, -5m, now, or epoch ms.";

    private static final DateTimeFormatter ISO = new DateTimeFormatterBuilder()
            .append(DateTimeFormatter.ISO_LOCAL_DATE)
            .optionalStart()
            .appendLiteral('T')
            .append(DateTimeFormatter.ISO_LOCAL_TIME)
            .appendPattern("[XXX]")
            .toFormatter(Locale.ROOT)
            .withChronology(IsoChronology.INSTANCE)
            .withResolverStyle(ResolverStyle.STRICT);
    private static final DurationConverter DURATIONS = new DurationConverter();

    private final boolean ahead;

    public TimeConverter() {
        this(false);
    }

    private TimeConverter(boolean ahead) {
        this.ahead = ahead;
    }

    /** Takes the next one of a time of day. */
    public static final class Next extends TimeConverter {
        public Next() {
            super(true);
        }
    }

    @Override
    public Instant convert(String text) {
        return convert(text, ZonedDateTime.now());
    }

    Instant convert(String text, ZonedDateTime now) {
        try {
            if (text.equals("now")) {
                return now.toInstant();
            } else if (text.matches("[0-9]{1,15}")) {
                return Instant.ofEpochMilli(Long.parseLong(text));
            } else if (text.startsWith("-") || text.startsWith("+")) {
                Duration distance = DURATIONS.convert(text.substring(1));
                return now.toInstant().plus(text.startsWith("-") ? distance.negated() : distance);
            } else if (text.matches("[0-9]{2}:[0-9]{2}(:[0-9]{2})?")) {
                return timeOfDay(LocalTime.parse(text), now);
            }
            TemporalAccessor time = ISO.parseBest(text, OffsetDateTime::from, LocalDateTime::from, LocalDate::from);
            if (time instanceof OffsetDateTime offset) {
                return offset.toInstant();
            }
            return (time instanceof LocalDateTime local
                            ? local.atZone(now.getZone())
                            : LocalDate.from(time).atStartOfDay(now.getZone()))
                    .toInstant();
        } catch (DateTimeException | ArithmeticException | TypeConversionException e) {
            throw new TypeConversionException(
                    "'%s' is not a time; write for instance 2026-05-01T08:00:00, 06:00, -5m or now".formatted(text));
        }
    }

    private Instant timeOfDay(LocalTime time, ZonedDateTime now) {
        ZonedDateTime today = now.with(time);
        if (ahead) {
            return (today.isBefore(now) ? today.plusDays(1) : today).toInstant();
        }
        return (today.isAfter(now) ? today.minusDays(1) : today).toInstant();
    }
}
