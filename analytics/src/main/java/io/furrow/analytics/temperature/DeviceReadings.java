package io.furrow.analytics.temperature;

import java.util.List;

import io.furrow.model.event.FiwareScope;

/**
 * What one device measured in one field and window so far; the state of a window that is still open.
 *
 * @param device entity id
 * @param values in the attribute's unit, in order of arrival
 */
public record DeviceReadings(String field, String domain, FiwareScope scope, String device, List<Double> values) {}
