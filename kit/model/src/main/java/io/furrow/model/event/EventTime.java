package io.furrow.model.event;

import java.time.Duration;
import java.time.Instant;
import java.time.temporal.ChronoUnit;

import io.furrow.model.ngsi.Entity;

/**
 * When an event happened, as an {@link EventTimeRule} has it; by default the device's own time, else when the context broker changed
 * what it reports, else the time of receipt. A date and time without offset is UTC, as NGSI-v2 has it.
 *
 * @param time whole milliseconds, at most ten years before the receipt and the allowed skew after it
 * @param basis what it was taken from
 * @param fault what is wrong with the time that the device gives; null if nothing is
 */
public record EventTime(Instant time, Basis basis, Fault fault) {
    /** What an event time was taken from. */
    public enum Basis {
        DEVICE,
        BROKER,
        RECEIPT
    }

    /** Why the time that the device gives is not that of the event. */
    public enum Fault {
        /** Further in the future than allowed: the time of receipt stands for it. */
        AHEAD,
        /** Longer ago than a measure can be: the time of receipt stands for it. */
        UNSET,
        /** No form of a time is known in which it can be read. */
        UNREADABLE
    }

    /** Clocks that were never set show 1970, 1980 (GPS) or 2000. */
    private static final Duration MAX_AGE = Duration.ofDays(3650);

    /** Whole milliseconds: what a record timestamp can hold, so that all copies of the time agree. */
    public EventTime {
        time = time.truncatedTo(ChronoUnit.MILLIS);
    }

    /** @param received when the event came in */
    public static EventTime of(Entity entity, Instant received, EventTimeRule rule) {
        Instant earliest = received.minus(MAX_AGE);
        Instant latest = received.plus(rule.maxSkew());
        Fault fault = null;
        for (EventTimeRule.Source source : rule.order()) {
            Instant time = source.read(entity).orElse(null);
            boolean isOfDevice = source == EventTimeRule.Source.DEVICE;
            if (time != null && !time.isAfter(latest) && !time.isBefore(earliest)) {
                return new EventTime(time, isOfDevice ? Basis.DEVICE : Basis.BROKER, fault);
            } else if (time != null && isOfDevice) {
                return new EventTime(received, Basis.RECEIPT, time.isAfter(latest) ? Fault.AHEAD : Fault.UNSET);
            } else if (isOfDevice && source.isNamed(entity)) {
                fault = Fault.UNREADABLE;
            }
        }
        return new EventTime(received, Basis.RECEIPT, fault);
    }
}
