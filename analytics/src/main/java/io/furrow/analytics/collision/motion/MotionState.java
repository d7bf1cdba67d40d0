package io.furrow.analytics.collision.motion;

import io.furrow.analytics.position.PositionFix;

/**
 * What is known of one device's motion.
 *
 * @param last the newest position
 * @param ahead the segment that begins there; null if no course is known
 */
public record MotionState(PositionFix last, MotionSegment ahead) {}
