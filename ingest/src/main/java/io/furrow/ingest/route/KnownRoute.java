package io.furrow.ingest.route;

/**
 * Where the newest event of an entity went.
 *
 * @param time of that event, epoch ms
 */
public record KnownRoute(String domain, String mission, long time) {}
