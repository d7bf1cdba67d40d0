package io.furrow.model.event;

import java.time.Instant;
import java.time.temporal.ChronoUnit;
import java.util.Comparator;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Optional;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.time.Instants;

/**
 * A change of an entity as a source emits it: key = {@link Entity#id()}, value = {@link Entity#toBytes()}, record
 * timestamp = {@link EventTime#time()}, headers = {@link #headers(String)}.
 *
 * @param received when the source received it
 */
public record EntityEvent(Entity entity, FiwareScope scope, EventTime time, Instant received, Origin origin) {
    private static final String TIME_INSTANT = "TimeInstant";

    /** Returns an event whose time is read from the entity, see {@link EventTimeRule}. */
    public static EntityEvent of(
            Entity entity, FiwareScope scope, Instant received, EventTimeRule rule, Origin origin) {
        return new EntityEvent(entity, scope, EventTime.of(entity, received, rule), received, origin);
    }

    public String id() {
        return EventId.of(scope, entity, time.time());
    }

    /** Returns the headers of {@link HeaderNames} in a fixed order; {@code source} becomes {@code ce_source}. */
    public Map<String, String> headers(String source) {
        Map<String, String> headers = new LinkedHashMap<>();
        headers.put(HeaderNames.CE_ID, id());
        headers.put(HeaderNames.CE_SOURCE, source);
        headers.put(HeaderNames.CE_TIME, time.time().toString());
        headers.put(HeaderNames.CE_SPECVERSION, HeaderNames.SPECVERSION);
        headers.put(HeaderNames.CE_TYPE, HeaderNames.TYPE_CHANGED);
        headers.put(HeaderNames.SERVICE, scope.service());
        headers.put(HeaderNames.SERVICE_PATH, scope.servicePath());
        String later = laterAttributes();
        if (!later.isEmpty()) {
            headers.put(HeaderNames.LATER_ATTRIBUTES, later);
        }
        headers.put(HeaderNames.ORIGIN, origin.code());
        headers.put(HeaderNames.TS_DEVICE, Long.toString(time.time().toEpochMilli()));
        headers.put(HeaderNames.TS_SOURCE, Long.toString(received.toEpochMilli()));
        return headers;
    }

    /**
     * Returns the attributes that are later than the measure, of which the context broker retains newer ones. What writes
     * the entity stamps each attribute: an IoT Agent perhaps with the time of arrival, so that the stamp of the measure
     * counts if it is after the device's time. The device's time may be the interval of the measure, or truncated to the
     * second or minute.
     */
    private String laterAttributes() {
        if (time.basis() != EventTime.Basis.DEVICE) {
            return "";
        }
        Instant measured = Stream.of(Optional.of(time.time()), stampOfMeasure(), endOfMeasure())
                .flatMap(Optional::stream)
                .max(Comparator.naturalOrder())
                .orElseThrow();
        boolean isMinute = time.time().equals(time.time().truncatedTo(ChronoUnit.MINUTES));
        ChronoUnit precision = isMinute ? ChronoUnit.MINUTES : ChronoUnit.SECONDS;
        return entity.attributes().stream()
                .filter(attribute -> stampOf(attribute.getValue())
                        .map(stamp -> stamp.truncatedTo(precision))
                        .filter(measured::isBefore)
                        .isPresent())
                .map(Map.Entry::getKey)
                .collect(Collectors.joining(","));
    }

    /** Returns {@code TimeInstant}, or else the stamp of the attribute with the device's time. */
    private Optional<Instant> stampOfMeasure() {
        return entity.value(TIME_INSTANT)
                .flatMap(Instants::of)
                .or(() -> EventTimeRule.Source.DEVICE_TIMES.stream()
                        .filter(name -> entity.value(name).flatMap(Instants::of).isPresent())
                        .findFirst()
                        .flatMap(name -> stampOf(entity.json().path(name))));
    }

    private Optional<Instant> endOfMeasure() {
        return EventTimeRule.Source.DEVICE_TIMES.stream()
                .flatMap(name -> entity.text(name).stream())
                .findFirst()
                .flatMap(Instants::endOfInterval);
    }

    private static Optional<Instant> stampOf(JsonNode attribute) {
        return Instants.of(attribute.path("metadata").path(TIME_INSTANT).path("value"));
    }
}
