package io.furrow.connect.journal;

/**
 * A record as it was appended.
 *
 * @param sequence counts records from 0; it is never given twice, but numbers may be left out
 */
public record JournalRecord(long sequence, byte[] payload) {}
