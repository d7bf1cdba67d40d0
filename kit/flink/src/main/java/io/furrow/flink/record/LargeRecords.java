package io.furrow.flink.record;

import java.util.Arrays;

import io.furrow.model.event.OriginalReference;

/**
 * Replaces a large record by a reference to its position, because late and dead records are written again, perhaps by several
 * jobs. Large is a value above {@value #LARGE} bytes, a quarter of Kafka's default limit.
 */
public final class LargeRecords {
    static final int LARGE = 256 * 1024;
    /** Bytes of the value that remain, for inspection. */
    static final int BEGINNING = 4 * 1024;

    private LargeRecords() {}

    /** Whether the record is large and stored on a topic; otherwise there is no position to refer to. */
    public static boolean isLarge(TopicRecord record) {
        return record.value() != null && record.value().length > LARGE && record.offset() >= 0;
    }

    /** The record itself, or, if it is large, the beginning of its value, with the headers of its {@link OriginalReference}. */
    static TopicRecord beginning(TopicRecord record) {
        return isLarge(record) ? reduced(record, Arrays.copyOf(record.value(), BEGINNING)) : record;
    }

    /** A large record with another value, and the headers of its {@link OriginalReference}. */
    public static TopicRecord reduced(TopicRecord record, byte[] value) {
        OriginalReference originalReference =
                new OriginalReference(record.topic(), record.partition(), record.offset(), record.value().length);
        return record.withValue(value).with(originalReference.headers());
    }
}
