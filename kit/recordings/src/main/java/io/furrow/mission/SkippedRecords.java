package io.furrow.mission;

/**
 * Records of a recording that hold no event.
 *
 * @param what for instance {@code document 5f01…} or {@code hoeing.ndjson, line 12}
 * @param reason for people
 * @param count how many records this stands for
 */
public record SkippedRecords(String what, String reason, long count) {}
