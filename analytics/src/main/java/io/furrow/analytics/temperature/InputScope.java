package io.furrow.analytics.temperature;

import io.furrow.model.event.FiwareScope;

/**
 * The scope within which an id is unique: input topic, tenant and service path. Readings of two topics, as a live and
 * a replayed one, never meet in a window, nor do those of two tenants.
 *
 * @param topic the input topic
 * @param fiware tenant and service path
 */
public record InputScope(String topic, FiwareScope fiware) {
    /** One text per id of this scope. A topic's name has no {@code |}. */
    String identity(String id) {
        return topic + '|' + fiware.identity(id);
    }
}
