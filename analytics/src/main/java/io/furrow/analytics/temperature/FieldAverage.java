package io.furrow.analytics.temperature;

import java.util.List;

/**
 * The average of a field in one window.
 *
 * @param domain empty if the field belongs to none
 * @param scope of the devices that were averaged
 * @param windowStart first instant of the window, epoch ms
 * @param windowEnd first instant after the window, epoch ms
 * @param suspectTypes of the entities of its suspects, in their order; empty where it is not known
 */
public record FieldAverage(
        String field,
        String domain,
        InputScope scope,
        long windowStart,
        long windowEnd,
        RobustMean average,
        List<String> suspectTypes) {
    /** The field among those of all topics and tenants. */
    String fieldIdentity() {
        return scope.identity(field);
    }
}
