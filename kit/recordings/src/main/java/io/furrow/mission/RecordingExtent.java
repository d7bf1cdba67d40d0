package io.furrow.mission;

/**
 * The extent of a recording.
 *
 * @param first event time of the oldest event, epoch ms
 * @param last event time of the newest event, epoch ms, inclusive
 */
public record RecordingExtent(long first, long last) {}
