package io.furrow.connect.source;

import java.util.Map;
import java.util.OptionalLong;

import org.apache.kafka.connect.errors.ConnectException;
import org.apache.kafka.connect.storage.OffsetStorageReader;

/**
 * The source's partitions and offsets: {@code {"journal": id}} and {@code {"record": n}}. n is the number of the first
 * record that is not confirmed in Kafka.
 */
final class SourceOffsets {
    private static final String JOURNAL = "journal";
    private static final String RECORD = "record";
    private static final String PARTITION_SHAPE = "a partition is {\"journal\": \"<id>\"}, as GET …/offsets shows it";
    private static final String OFFSET_SHAPE =
            "an offset is {\"record\": n} with a whole number n of at least 0, or null";

    private SourceOffsets() {}

    static Map<String, String> partition(String journal) {
        return Map.of(JOURNAL, journal);
    }

    /** The offset of a record: the number of the next one. */
    static Map<String, Long> offsetOf(long sequence) {
        return Map.of(RECORD, sequence + 1);
    }

    static String journalOf(Map<String, ?> partition) {
        return (String) partition.get(JOURNAL);
    }

    static long sequenceOf(Map<String, ?> offset) {
        return ((Number) offset.get(RECORD)).longValue() - 1;
    }

    /** The committed offset of a journal; empty if there is none, for instance after a reset. */
    static OptionalLong committed(OffsetStorageReader reader, String journal) {
        Map<String, Object> offset = reader.offset(partition(journal));
        if (offset == null) {
            return OptionalLong.empty();
        }
        requireOffset(offset);
        return OptionalLong.of(((Number) offset.get(RECORD)).longValue());
    }

    /** @throws ConnectException describing the invalid part and the expected shape */
    static void require(Map<String, ?> partition, Map<String, ?> offset) {
        boolean named = partition != null
                && partition.size() == 1
                && partition.get(JOURNAL) instanceof String id
                && !id.isBlank();
        if (!named) {
            throw new ConnectException("not a partition of this source: " + partition + "; " + PARTITION_SHAPE);
        }
        if (offset != null) {
            requireOffset(offset);
        }
    }

    private static void requireOffset(Map<String, ?> offset) {
        Object record = offset.get(RECORD);
        boolean whole = record instanceof Long || record instanceof Integer;
        if (offset.size() != 1 || !whole || ((Number) record).longValue() < 0) {
            throw new ConnectException("not an offset of this source: " + offset + "; " + OFFSET_SHAPE);
        }
    }
}
