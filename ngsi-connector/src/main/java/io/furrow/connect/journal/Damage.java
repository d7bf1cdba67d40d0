package io.furrow.connect.journal;

/**
 * A part of a segment file that cannot be read.
 *
 * @param segment sequence number that the file begins with
 * @param from position in the file
 * @param to position in the file, exclusive; the same as {@code from} where nothing is left to skip
 * @param sequence the first number that is missing
 * @param records how many are missing; {@link #UNKNOWN} at the end of the last file, where that can also be none
 * @param kind what it looks like
 */
public record Damage(long segment, long from, long to, long sequence, long records, Kind kind) {
    /** The number of missing records cannot be told. */
    public static final long UNKNOWN = -1;

    /** What a damage looks like. */
    public enum Kind {
        /** An append that had not ended when the process or the machine died; nobody was told that it was durable. */
        TORN_TAIL,
        /** Bytes changed after they were written. */
        CORRUPT,
        /** The file is shorter than it was made. */
        TRUNCATED,
        /** A file is gone, or its beginning cannot be read. */
        MISSING
    }

    long bytes() {
        return to - from;
    }
}
