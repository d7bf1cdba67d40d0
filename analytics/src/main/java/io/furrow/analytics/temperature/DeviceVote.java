package io.furrow.analytics.temperature;

import io.furrow.model.event.FiwareScope;

/**
 * The one value that a device has in a field's window.
 *
 * @param device entity id
 * @param value the median of its readings, in the attribute's unit
 * @param windowStart first instant of the window, epoch ms
 * @param windowEnd first instant after the window, epoch ms
 */
public record DeviceVote(
        String field, String domain, FiwareScope scope, String device, double value, long windowStart, long windowEnd) {
    /** The field among those of all tenants: devices of two tenants are never averaged together. */
    public String fieldIdentity() {
        return scope.identity(field);
    }
}
