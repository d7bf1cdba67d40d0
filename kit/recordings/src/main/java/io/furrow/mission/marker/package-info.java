/** Markers: moments of a mission with a note. */
package io.furrow.mission.marker;
