package io.furrow.model.event;

import java.time.DateTimeException;
import java.time.Duration;
import java.time.Instant;
import java.time.LocalDateTime;
import java.time.OffsetDateTime;
import java.time.ZoneOffset;
import java.time.chrono.IsoChronology;
import java.time.format.DateTimeFormatter;
import java.time.format.DateTimeFormatterBuilder;
import java.time.format.ResolverStyle;
import java.time.temporal.ChronoUnit;
import java.time.temporal.TemporalAccessor;
import java.util.List;
import java.util.Locale;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.Entity;

/**
 * When an event happened: {@code Time} (epoch ms), else {@code TimeInstant}, {@code dateObserved}, {@code timestamp} (ISO
 * 8601 or epoch ms), else {@code dateModified} of the context broker, else the time of receipt. The first of these that can be
 * read decides. A date and time without offset is UTC, as NGSI-v2 has it.
 *
 * @param time whole milliseconds, never before 1970, at most the allowed skew after the receipt
 * @param basis what it was taken from
 */
public record EventTime(Instant time, Basis basis) {
    /** What an event time was taken from. */
    public enum Basis {
        DEVICE,
        BROKER,
        RECEIPT,
        /** The entity's own time was further in the future than allowed, so the time of receipt stands for it. */
        RECEIPT_FOR_FUTURE
    }

    /** Whole milliseconds: what a record timestamp can hold, so that all copies of the time agree. */
    public EventTime {
        time = time.truncatedTo(ChronoUnit.MILLIS);
    }

    /** The year 33658: 15 digits of milliseconds. What is later is no time. */
    private static final double LATEST_MILLIS = 999_999_999_999_999d;

    private static final DateTimeFormatter ISO = new DateTimeFormatterBuilder()
            .append(DateTimeFormatter.ISO_LOCAL_DATE_TIME)
            .appendPattern("[XXX][XX][X]")
            .toFormatter(Locale.ROOT)
            .withResolverStyle(ResolverStyle.STRICT)
            .withChronology(IsoChronology.INSTANCE);

    private static final List<String> DEVICE_TIMES = List.of("Time", "TimeInstant", "dateObserved", "timestamp");

    /**
     * @param received when the event came in
     * @param maxSkew how far the device's clock may be ahead
     */
    public static EventTime of(Entity entity, Instant received, Duration maxSkew) {
        Optional<Instant> device = DEVICE_TIMES.stream()
                .flatMap(name -> entity.value(name).flatMap(EventTime::instant).stream())
                .findFirst();
        if (device.isEmpty()) {
            return entity.value("dateModified")
                    .flatMap(EventTime::instant)
                    .filter(time -> !time.isAfter(received.plus(maxSkew)))
                    .map(time -> new EventTime(time, Basis.BROKER))
                    .orElseGet(() -> new EventTime(received, Basis.RECEIPT));
        }
        return device.get().isAfter(received.plus(maxSkew))
                ? new EventTime(received, Basis.RECEIPT_FOR_FUTURE)
                : new EventTime(device.get(), Basis.DEVICE);
    }

    /** The time that a value names; empty where it names none. */
    static Optional<Instant> instant(JsonNode value) {
        return (value.isTextual() ? fromText(value.textValue().trim()) : fromNumber(value))
                .filter(time -> time.toEpochMilli() >= 0);
    }

    private static Optional<Instant> fromNumber(JsonNode value) {
        double millis = value.isNumber() ? value.doubleValue() : Double.NaN;
        return Math.abs(millis) <= LATEST_MILLIS ? Optional.of(Instant.ofEpochMilli((long) millis)) : Optional.empty();
    }

    /** ISO 8601 date and time, the start of an ISO 8601 interval, or the digits of epoch milliseconds. */
    private static Optional<Instant> fromText(String text) {
        if (text.matches("\\d{1,15}")) {
            return Optional.of(Instant.ofEpochMilli(Long.parseLong(text)));
        }
        int slash = text.indexOf('/');
        try {
            TemporalAccessor time = ISO.parseBest(
                    slash < 0 ? text : text.substring(0, slash), OffsetDateTime::from, LocalDateTime::from);
            Instant instant = time instanceof OffsetDateTime offset
                    ? offset.toInstant()
                    : ((LocalDateTime) time).toInstant(ZoneOffset.UTC);
            return Optional.of(instant).filter(it -> Math.abs(it.getEpochSecond()) < LATEST_MILLIS / 1000);
        } catch (DateTimeException e) {
            return Optional.empty();
        }
    }
}
