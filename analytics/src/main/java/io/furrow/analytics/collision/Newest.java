package io.furrow.analytics.collision;

/**
 * Where a device is by what has arrived.
 *
 * @param track the newest position by event time, and the cells that know of it
 * @param version of that
 */
public record Newest(Track track, long version) {}
