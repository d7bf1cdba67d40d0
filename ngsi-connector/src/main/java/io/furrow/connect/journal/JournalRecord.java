package io.furrow.connect.journal;

/**
 * An appended record.
 *
 * @param sequence counts records from 0; never reused, but numbers may be skipped
 */
public record JournalRecord(long sequence, byte[] payload) {}
