/** Computes a field's average temperature in event-time windows, robust against defective thermometers. */
package io.furrow.analytics.temperature;
