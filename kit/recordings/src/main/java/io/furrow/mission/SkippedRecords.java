package io.furrow.mission;

/**
 * Records of a recording without a valid event.
 *
 * @param what for instance {@code document 5f01…} or {@code hoeing.ndjson, line 12}
 * @param reason for people
 * @param count number of records
 */
public record SkippedRecords(String what, String reason, long count) {}
