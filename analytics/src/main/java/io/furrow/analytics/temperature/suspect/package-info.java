/** Devices whose values deviate from the others of their field in window after window. */
package io.furrow.analytics.temperature.suspect;
