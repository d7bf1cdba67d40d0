package io.furrow.ingest.latest;

/**
 * The newest that is known of an attribute.
 *
 * @param time event time, epoch ms
 * @param json type, value and metadata as they were reported
 */
public record LatestAttribute(long time, String json) {}
