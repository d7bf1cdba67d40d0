package io.furrow.connect.journal;

/**
 * A part of a segment file that cannot be read.
 *
 * @param segment first sequence number of the file
 * @param from position in the file
 * @param to position in the file, exclusive; the same as {@code from} if nothing is left to skip
 * @param sequence the first missing number
 * @param records number of missing records; {@link #UNKNOWN} at the end of the last file, where it may also be zero
 * @param kind the presumed cause
 */
public record Corruption(long segment, long from, long to, long sequence, long records, Kind kind) {
    /** The number of missing records is unknown. */
    public static final long UNKNOWN = -1;

    /** The presumed cause of a corruption. */
    public enum Kind {
        /** An append was incomplete when the process or the machine died; its durability was never reported. */
        TORN_TAIL,
        /** Bytes changed after they were written. */
        CORRUPT,
        /** The file is shorter than it was created. */
        TRUNCATED,
        /** A file is missing, or its beginning cannot be read. */
        MISSING
    }

    long bytes() {
        return to - from;
    }
}
