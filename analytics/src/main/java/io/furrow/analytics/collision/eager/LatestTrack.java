package io.furrow.analytics.collision.eager;

import io.furrow.analytics.collision.grid.Track;

/**
 * Where a device is by what has arrived.
 *
 * @param track the newest position by event time, and the cells that know of it
 * @param version of that
 */
public record LatestTrack(Track track, long version) {}
