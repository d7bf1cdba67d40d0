package io.furrow.ingest.route;

/**
 * The route of an entity's newest event.
 *
 * @param type of the entity
 * @param time of that event, epoch ms
 * @param received when it was received, epoch ms; before {@code time} if the device's clock is ahead
 */
public record CachedRoute(String type, String domain, String mission, long time, long received) {}
