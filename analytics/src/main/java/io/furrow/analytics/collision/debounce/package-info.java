/** Removes encounters that flicker or are short: hysteresis and dwell. */
package io.furrow.analytics.collision.debounce;
