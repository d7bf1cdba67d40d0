package io.furrow.model.event;

import java.time.Duration;
import java.time.Instant;
import java.time.temporal.ChronoUnit;
import java.util.List;
import java.util.Optional;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Instants;

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

    private static final List<String> DEVICE_TIMES = List.of("Time", "TimeInstant", "dateObserved", "timestamp");

    /**
     * @param received when the event came in
     * @param maxSkew how far the device's clock may be ahead
     */
    public static EventTime of(Entity entity, Instant received, Duration maxSkew) {
        Optional<Instant> device = DEVICE_TIMES.stream()
                .flatMap(name -> entity.value(name).flatMap(Instants::of).stream())
                .findFirst();
        if (device.isEmpty()) {
            return entity.value("dateModified")
                    .flatMap(Instants::of)
                    .filter(time -> !time.isAfter(received.plus(maxSkew)))
                    .map(time -> new EventTime(time, Basis.BROKER))
                    .orElseGet(() -> new EventTime(received, Basis.RECEIPT));
        }
        return device.get().isAfter(received.plus(maxSkew))
                ? new EventTime(received, Basis.RECEIPT_FOR_FUTURE)
                : new EventTime(device.get(), Basis.DEVICE);
    }
}
