package io.furrow.analytics.temperature;

import io.furrow.model.event.FiwareScope;

/**
 * The scope within which an id is unique: input topic, tenant and service path. Readings of two topics, such as a live
 * and a replayed one, or of two tenants never share a window.
 *
 * @param topic the input topic
 * @param fiware tenant and service path
 */
public record InputScope(String topic, FiwareScope fiware) {
    /** Unique per id of this scope. A topic's name has no {@code |}. */
    String identity(String id) {
        return topic + '|' + fiware.identity(id);
    }

    /** Unique per type and id of this scope. */
    String identity(String type, String id) {
        return topic + '|' + fiware.identity(type, id);
    }
}
