package io.furrow.ingest.latest;

/**
 * The newest value of an attribute.
 *
 * @param time event time, epoch ms
 * @param json type, value and metadata as reported
 */
public record LatestAttribute(long time, String json) {}
