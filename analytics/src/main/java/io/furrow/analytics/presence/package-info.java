/**
 * Which device is in which field, from when to when, in event time. A device is in a field while the field's version of that
 * time covers the newest position that counts; a position counts from its time until that of the next, at most for the
 * time-to-live. What comes of it is a pure function of the positions and of the versions that were known in time.
 */
package io.furrow.analytics.presence;
