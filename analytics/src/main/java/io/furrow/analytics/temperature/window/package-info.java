/** Averages of a field per window of event time. */
package io.furrow.analytics.temperature.window;
