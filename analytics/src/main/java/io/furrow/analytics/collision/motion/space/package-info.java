/** Distances and neighbors of straight motions in space. */
package io.furrow.analytics.collision.motion.space;
