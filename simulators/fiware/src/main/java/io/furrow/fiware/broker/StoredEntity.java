package io.furrow.fiware.broker;

import java.time.Instant;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.event.FiwareScope;

/**
 * An immutable state of an entity.
 *
 * @param scope tenant and service path
 * @param attributes in the order of a notification of this state, see {@link EntityChange}
 * @param modified time of the last update, also of one without changes
 */
public record StoredEntity(
        FiwareScope scope,
        String id,
        String type,
        Map<String, StoredAttribute> attributes,
        Instant created,
        Instant modified) {
    private static final int SMALL = 64;

    public StoredEntity {
        attributes = Collections.unmodifiableMap(new LinkedHashMap<>(attributes));
    }

    /** Approximate size in bytes, for the limits of queues. */
    long weight() {
        long weight = SMALL;
        for (StoredAttribute attribute : attributes.values()) {
            JsonNode value = attribute.value();
            weight += SMALL + (value.isTextual() ? value.textValue().length() : SMALL * (long) value.size());
        }
        return weight;
    }
}
