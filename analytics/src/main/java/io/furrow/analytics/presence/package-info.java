/**
 * Determines which device is in which field, and for how long, in event time. A device is in a field while the field's
 * version of that time covers its newest valid position; a position is valid until the time of the next, at most for the
 * time-to-live. The result is a pure function of the positions and of the versions that arrived in time.
 */
package io.furrow.analytics.presence;
