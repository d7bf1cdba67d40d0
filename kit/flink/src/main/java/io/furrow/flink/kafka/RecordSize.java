package io.furrow.flink.kafka;

import org.apache.kafka.common.compress.Compression;
import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.record.MemoryRecords;
import org.apache.kafka.common.record.SimpleRecord;

import io.furrow.flink.record.TextHeaders;
import io.furrow.flink.record.TopicRecord;

/** The size of a record: in a producer, which overestimates it, and at the broker, as a separate batch. */
final class RecordSize {
    /** Bytes of a batch, and of the record's numbers and lengths at most. */
    private static final long OVERHEAD = 61 + 21 + 3 * 5;
    /** The lengths of the name and the text of a header, at most. */
    private static final long PER_HEADER = 2 * 5;

    private RecordSize() {}

    /**
     * Upper bound in bytes of the size that the producer compares with {@code max.request.size}, and of the uncompressed size
     * at the broker.
     */
    static long atMost(TopicRecord record) {
        long bytes = OVERHEAD + length(record.key()) + length(record.value());
        for (Header header : TextHeaders.of(record.headers()).bytes()) {
            bytes += PER_HEADER + utf8Length(header.key()) + header.value().length;
        }
        return bytes;
    }

    /** The exact size in bytes that the broker compares with {@code max.message.bytes}: costs as much as writing it. */
    static long atTheBroker(TopicRecord record, Compression compression) {
        Header[] headers = TextHeaders.of(record.headers()).bytes().toArray(Header[]::new);
        SimpleRecord alone = new SimpleRecord(Math.max(0, record.timestamp()), record.key(), record.value(), headers);
        return MemoryRecords.withRecords(compression, alone).sizeInBytes();
    }

    private static int length(byte[] bytes) {
        return bytes == null ? 0 : bytes.length;
    }

    private static int utf8Length(String text) {
        int bytes = text.length();
        for (int at = 0; at < text.length(); at++) {
            char sign = text.charAt(at);
            if (sign >= 0x80) {
                bytes += sign < 0x800 || Character.isSurrogate(sign) ? 1 : 2;
            }
        }
        return bytes;
    }
}
