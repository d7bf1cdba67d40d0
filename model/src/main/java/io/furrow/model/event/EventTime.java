package io.furrow.model.event;

import java.time.Instant;
import java.time.temporal.ChronoUnit;

import io.furrow.model.ngsi.Entity;

/**
 * When an event happened, as an {@link EventTimeRule} has it; by default the device's own time, else when the context broker changed
 * what it reports, else the time of receipt. A date and time without offset is UTC, as NGSI-v2 has it.
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

    /** @param received when the event came in */
    public static EventTime of(Entity entity, Instant received, EventTimeRule rule) {
        Instant latest = received.plus(rule.maxSkew());
        for (EventTimeRule.Source source : rule.order()) {
            Instant time = source.read(entity).orElse(null);
            if (time != null && !time.isAfter(latest)) {
                return new EventTime(time, source == EventTimeRule.Source.DEVICE ? Basis.DEVICE : Basis.BROKER);
            } else if (time != null && source == EventTimeRule.Source.DEVICE) {
                return new EventTime(received, Basis.RECEIPT_FOR_FUTURE);
            }
        }
        return new EventTime(received, Basis.RECEIPT);
    }
}
