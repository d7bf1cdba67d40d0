package io.furrow.flink.record;

import java.util.Arrays;

import io.furrow.model.event.OriginalReference;

/**
 * Stands for a large record by where it is, because what is late or dead is written beside it, perhaps by several jobs. Large is
 * a value above {@value #LARGE} bytes, a quarter of what a topic of Kafka's default settings takes.
 */
public final class LargeRecords {
    static final int LARGE = 256 * 1024;
    /** Bytes of the value that stay, to be looked at. */
    static final int BEGINNING = 4 * 1024;

    private LargeRecords() {}

    /** Whether the record is large, and still there to be read; what was never on a topic can stand for itself alone. */
    public static boolean isLarge(TopicRecord record) {
        return record.value() != null && record.value().length > LARGE && record.offset() >= 0;
    }

    /** The record itself, or, where it is large, the beginning of its value, with the headers of its {@link OriginalReference}. */
    static TopicRecord beginning(TopicRecord record) {
        return isLarge(record) ? reduced(record, Arrays.copyOf(record.value(), BEGINNING)) : record;
    }

    /** A large record with a value in its place, and the headers of its {@link OriginalReference}. */
    public static TopicRecord reduced(TopicRecord record, byte[] value) {
        OriginalReference originalReference =
                new OriginalReference(record.topic(), record.partition(), record.offset(), record.value().length);
        return record.withValue(value).with(originalReference.headers());
    }
}
