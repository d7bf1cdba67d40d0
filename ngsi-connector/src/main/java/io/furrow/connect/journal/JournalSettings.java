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

    /** Bytes of files that records of this many bytes may need if there is none yet; it errs on the side of too many. */
    long needed(long bytes) {
        long usableOfSegment = segmentBytes / 4 * 3;
        long newFiles = (bytes / usableOfSegment + 1) * segmentBytes;
        // What does not fit well into files of the usual size gets its own.
        long largeFiles = bytes > segmentBytes / 4 ? bytes + SegmentFormat.HEADER : 0;
        return newFiles + largeFiles;
    }

    /** Bytes of records that always fit into an empty journal at once. */
    public long largestAppend() {
        return (maxBytes - segmentBytes - SegmentFormat.HEADER) / 7 * 3;
    }
}
