package io.furrow.model.event;

import java.time.Duration;
import java.time.Instant;
import java.time.temporal.ChronoUnit;

import io.furrow.model.ngsi.Entity;

/**
 * The time of an event according to an {@link EventTimeRule}: by default the device's own time, else when the context
 * broker changed the entity, else the time of receipt. A date and time without offset is UTC, as in NGSI-v2.
 *
 * @param time whole milliseconds, at most ten years before the receipt and the allowed skew after it
 * @param basis its origin
 * @param fault what is wrong with the device's time; null if nothing is
 */
public record EventTime(Instant time, Basis basis, Fault fault) {
    /** The origin of an event time. */
    public enum Basis {
        DEVICE,
        BROKER,
        RECEIPT
    }

    /** Why the device's time is not the event time. */
    public enum Fault {
        /** Further in the future than allowed; replaced by the time of receipt. */
        AHEAD,
        /** Older than a measure can be; replaced by the time of receipt. */
        UNSET,
        /** Not in a supported format. */
        UNREADABLE
    }

    /** Clocks that were never set show 1970, 1980 (GPS) or 2000. */
    private static final Duration MAX_AGE = Duration.ofDays(3650);

    /** Truncates the time to whole milliseconds, the precision of record timestamps, so that all copies of it agree. */
    public EventTime {
        time = time.truncatedTo(ChronoUnit.MILLIS);
    }

    /** @param received when the event was received */
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
