package io.furrow.analytics.temperature;

import java.util.List;

/**
 * The average of a field in one window.
 *
 * @param domain empty if the field has none
 * @param scope of the averaged devices
 * @param windowStart first instant of the window, epoch ms
 * @param windowEnd first instant after the window, epoch ms
 * @param suspectTypes entity types of the suspects, in their order; empty if unknown
 */
public record FieldAverage(
        String field,
        String domain,
        InputScope scope,
        long windowStart,
        long windowEnd,
        RobustMean average,
        List<String> suspectTypes) {
    /** The field, unique across topics and tenants. */
    String fieldIdentity() {
        return scope.identity(field);
    }
}
