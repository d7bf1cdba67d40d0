package io.furrow.model.event;

import java.time.Instant;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.stream.Collectors;

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
     * Returns the attributes that are later than the measure. The IoT Agent stamps each attribute and the entity with
     * the time of the measure, and merging retains newer attributes.
     */
    private String laterAttributes() {
        Instant measured = entity.value(TIME_INSTANT)
                .flatMap(Instants::of)
                .map(stamp -> stamp.isAfter(time.time()) ? stamp : time.time()) // the stamp may be impossible
                .orElse(Instant.MAX);
        return entity.attributes().stream()
                .filter(attribute -> Instants.of(attribute
                                .getValue()
                                .path("metadata")
                                .path(TIME_INSTANT)
                                .path("value"))
                        .filter(measured::isBefore)
                        .isPresent())
                .map(Map.Entry::getKey)
                .collect(Collectors.joining(","));
    }
}
