package io.furrow.connect.journal;

/**
 * The bounds of a journal, in bytes.
 *
 * @param maxBytes of all segment files together
 * @param segmentBytes of one segment file; a record that is larger gets a file of its own size
 * @param maxWaiting of records that were handed in and are not on disk yet
 * @param minFree that stay free on the disk
 */
public record JournalSettings(long maxBytes, int segmentBytes, long maxWaiting, long minFree) {
    private static final int LARGEST_SEGMENT = 16 * 1024 * 1024;
    private static final int SEGMENTS_AT_LEAST = 8;

    /** The settings with segments of a size that suits the others. */
    public static JournalSettings of(long maxBytes, long maxWaiting, long minFree) {
        int segment = (int) Math.min(LARGEST_SEGMENT, maxBytes / SEGMENTS_AT_LEAST);
        return new JournalSettings(maxBytes, segment, maxWaiting, minFree);
    }
}
