package io.furrow.mission;

/**
 * The extent of a recording.
 *
 * @param first event time of the oldest event, epoch ms
 * @param last event time of the newest event, epoch ms, inclusive
 * @param events how many records with an event time there are; those that {@link Page#skipped} names later are among them
 */
public record Span(long first, long last, long events) {}
