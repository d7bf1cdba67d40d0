package io.furrow.connect.journal;

/**
 * The limits of a journal, in bytes.
 *
 * @param maxBytes of all segment files together
 * @param segmentBytes of one segment file; a larger record gets its own, larger file
 * @param maxWaiting of records that are not on disk yet
 * @param minFree that stay free on the disk
 */
public record JournalSettings(long maxBytes, int segmentBytes, long maxWaiting, long minFree) {
    private static final int LARGEST_SEGMENT = 16 * 1024 * 1024;
    private static final int SEGMENTS_AT_LEAST = 8;

    /** The settings with a suitable size of segments. */
    public static JournalSettings of(long maxBytes, long maxWaiting, long minFree) {
        int segment = (int) Math.min(LARGEST_SEGMENT, maxBytes / SEGMENTS_AT_LEAST);
        return new JournalSettings(maxBytes, segment, maxWaiting, minFree);
    }

    /** Upper bound of the size of files that records of this many bytes need in an empty journal. */
    long needed(long bytes) {
        long usableOfSegment = segmentBytes / 4 * 3;
        long newFiles = (bytes / usableOfSegment + 1) * segmentBytes;
        // Records that do not fit well into files of the usual size get their own.
        long largeFiles = bytes > segmentBytes / 4 ? bytes + SegmentFormat.HEADER : 0;
        return newFiles + largeFiles;
    }

    /** Bytes of records that always fit into an empty journal at once. */
    public long largestAppend() {
        return (maxBytes - segmentBytes - SegmentFormat.HEADER) / 7 * 3;
    }
}
