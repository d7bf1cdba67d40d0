package io.furrow.analytics.collision.motion;

import io.furrow.analytics.position.PositionFix;

/**
 * The motion of one device.
 *
 * @param last the newest position
 * @param ahead the segment that begins there; null if the course is unknown
 */
public record MotionState(PositionFix last, MotionSegment ahead) {}
