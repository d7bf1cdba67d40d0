package io.furrow.connect.journal;

import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.util.Locale;
import java.util.Optional;
import java.util.UUID;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.zip.CRC32C;

/**
 * The bytes of a segment file, big-endian: a header of {@value #HEADER} bytes, then records without a gap, then zeros up to
 * the preallocated length. A record is its length (4), sequence number (8), checksum (4) and payload. The checksum is the
 * CRC32C of the journal's own number, length, sequence and payload: a payload cannot pass for a record without that number.
 */
final class SegmentFormat {
    static final int HEADER = 64;
    static final int RECORD_HEADER = 16;

    private static final long MAGIC = 0x465552524f574a31L; // FURROWJ1
    private static final int CHECKED_OF_HEADER = 48;
    private static final Pattern NAME = Pattern.compile("(\\d{19})\\.segment");

    /**
     * The header of a segment.
     *
     * @param base the first sequence number of the segment
     * @param capacity length of the file at its creation
     * @param previous the base of the previous segment, or {@link #NONE}
     * @param previousEnd the end of the durable records of the previous segment; bytes after it are ignored
     */
    record Header(long base, long capacity, long previous, End previousEnd) {
        static final long NONE = -1;
    }

    /**
     * An end of durable records.
     *
     * @param position in the file
     * @param sequence number after the last record
     */
    record End(long position, long sequence) {}

    private SegmentFormat() {}

    static String fileName(long base) {
        return String.format(Locale.ROOT, "%019d.segment", base);
    }

    static Optional<Long> baseOf(String fileName) {
        Matcher matcher = NAME.matcher(fileName);
        return matcher.matches() ? Optional.of(Long.parseLong(matcher.group(1))) : Optional.empty();
    }

    /** A number of the journal that is part of each checksum. */
    static long saltOf(String journal) {
        return UUID.nameUUIDFromBytes(journal.getBytes(StandardCharsets.UTF_8)).getMostSignificantBits();
    }

    static int sizeOf(byte[] payload) {
        return RECORD_HEADER + payload.length;
    }

    static ByteBuffer write(Header header, long salt) {
        ByteBuffer bytes = ByteBuffer.allocate(HEADER);
        bytes.putLong(MAGIC).putLong(header.base()).putLong(header.capacity());
        bytes.putLong(header.previous());
        bytes.putLong(header.previousEnd().position())
                .putLong(header.previousEnd().sequence());
        bytes.putInt(headerChecksum(bytes, salt));
        return bytes.clear();
    }

    /** The header, unless it is corrupt or missing. */
    static Optional<Header> readHeader(ByteBuffer bytes, long salt) {
        if (bytes.remaining() < HEADER
                || bytes.getLong(0) != MAGIC
                || bytes.getInt(CHECKED_OF_HEADER) != headerChecksum(bytes, salt)) {
            return Optional.empty();
        }
        End previousEnd = new End(bytes.getLong(32), bytes.getLong(40));
        return Optional.of(new Header(bytes.getLong(8), bytes.getLong(16), bytes.getLong(24), previousEnd));
    }

    private static int headerChecksum(ByteBuffer bytes, long salt) {
        CRC32C crc = new CRC32C();
        crc.update(ByteBuffer.allocate(Long.BYTES).putLong(salt).flip());
        crc.update(bytes.duplicate().position(0).limit(CHECKED_OF_HEADER));
        return (int) crc.getValue();
    }

    /** Writes the header of a record to {@code into}, which is then ready to be read. */
    static void writeRecordHeader(ByteBuffer into, long salt, long sequence, byte[] payload) {
        into.clear().putInt(payload.length).putLong(sequence);
        CRC32C crc = seeded(salt, payload.length, sequence);
        crc.update(payload, 0, payload.length);
        into.putInt((int) crc.getValue()).flip();
    }

    /** The checksum of a record whose payload is the remaining bytes of {@code payload}. */
    static int checksum(long salt, long sequence, ByteBuffer payload) {
        CRC32C crc = seeded(salt, payload.remaining(), sequence);
        crc.update(payload);
        return (int) crc.getValue();
    }

    private static CRC32C seeded(long salt, int length, long sequence) {
        CRC32C crc = new CRC32C();
        crc.update(ByteBuffer.allocate(20)
                .putLong(salt)
                .putInt(length)
                .putLong(sequence)
                .flip());
        return crc;
    }
}
