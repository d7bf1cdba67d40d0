package io.furrow.analytics.temperature;

import java.util.List;

/**
 * What one device measured in one field and window so far; the state of a window that is still open.
 *
 * @param domain of the field, as of its newest version that a reading knows
 * @param validFrom of that version, epoch ms
 * @param device entity id
 * @param values in the attribute's unit, in order of arrival
 */
public record DeviceReadings(
        String field, String domain, long validFrom, InputScope scope, String device, List<Double> values) {}
