/**
 * Clocks of devices, judged by their positions: detects devices that are so far behind that their positions are late and, optionally,
 * corrects their times.
 */
package io.furrow.analytics.clock;
