/**
 * Predictions ahead of devices and crossings between their reports; never alters the start or the end of an encounter.
 *
 * <p>A <em>segment</em> is a straight, uniform motion of one device. A segment <em>behind</em> runs from one accepted position to the
 * next, if that comes before the first one's time-to-live ends. A segment <em>ahead</em> begins at a position and lasts as long as
 * the horizon; its speed and course are those of the report ({@code speed}, {@code heading}), else derived from the previous
 * position. Without a course, or above the maximum speed, there is no such segment.
 *
 * <p><b>Predicted</b>: at an instant t at which either device of a pair reported, both newest positions are valid and further apart
 * than the threshold, and their segments ahead come within the threshold between t and the end of the shorter of both. A prediction
 * lasts until it has not held for as long as the horizon.
 *
 * <p><b>Crossed</b>: an unbroken time during which two segments behind, and those that follow them, are within the threshold, while
 * at none of the reports at its edges and within it the newest positions of both were.
 *
 * <p>Segments are lines in space, not arcs, so that poles and the antimeridian are no special cases. A segment ahead of length s
 * leaves the sphere by s²/2R (3 cm after 600 m), one behind of length s dips below it by s²/8R; the error of a distance between two
 * devices is at most the greater of these.
 */
package io.furrow.analytics.collision.motion;
