package io.furrow.simulators.fiware;

import java.time.Instant;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.event.FiwareScope;

/**
 * A state of an entity; never changed, only replaced.
 *
 * @param scope tenant and service path
 * @param attributes in the order in which a notification of this state lists them, see {@link Change}
 * @param modified of the last update, also of one that changed nothing
 */
record StoredEntity(
        FiwareScope scope,
        String id,
        String type,
        Map<String, Attribute> attributes,
        Instant created,
        Instant modified) {
    private static final int SMALL = 64;

    StoredEntity {
        attributes = Collections.unmodifiableMap(new LinkedHashMap<>(attributes));
    }

    /** About how many bytes it takes to write: for the limits of queues, not exact. */
    long weight() {
        long weight = SMALL;
        for (Attribute attribute : attributes.values()) {
            JsonNode value = attribute.value();
            weight += SMALL + (value.isTextual() ? value.textValue().length() : SMALL * (long) value.size());
        }
        return weight;
    }
}
