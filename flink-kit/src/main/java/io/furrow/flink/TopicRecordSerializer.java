package io.furrow.flink;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.typeutils.TypeSerializer;
import org.apache.flink.api.common.typeutils.TypeSerializerSnapshot;
import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;
import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.header.internals.RecordHeader;

/**
 * Writes a {@link TopicRecord} for other subtasks and for state: the fields in their order, numbers in full, texts as UTF-8
 * behind their length, nothing as length −1. Records between subtasks are what a job has most of, and Flink's own serializer
 * of records writes texts sign by sign.
 */
final class TopicRecordSerializer extends TypeSerializer<TopicRecord> {
    static final TopicRecordSerializer INSTANCE = new TopicRecordSerializer();

    private static final long serialVersionUID = 1L;
    private static final int NOTHING = -1;

    @Override
    public void serialize(TopicRecord record, DataOutputView out) throws IOException {
        writeText(record.topic(), out);
        out.writeInt(record.partition());
        out.writeLong(record.offset());
        out.writeLong(record.timestamp());
        writeBytes(record.key(), out);
        writeBytes(record.value(), out);
        List<Header> headers = HeaderTexts.of(record.headers()).bytes();
        out.writeInt(headers.size());
        for (Header header : headers) {
            writeText(header.key(), out);
            writeBytes(header.value(), out);
        }
    }

    @Override
    public TopicRecord deserialize(DataInputView in) throws IOException {
        String topic = readText(in);
        int partition = in.readInt();
        long offset = in.readLong();
        long timestamp = in.readLong();
        byte[] key = readBytes(in);
        byte[] value = readBytes(in);
        Header[] headers = new Header[in.readInt()];
        for (int i = 0; i < headers.length; i++) {
            headers[i] = new RecordHeader(readText(in), readBytes(in));
        }
        return new TopicRecord(topic, partition, offset, timestamp, key, value, HeaderTexts.of(headers));
    }

    private static void writeText(String text, DataOutputView out) throws IOException {
        writeBytes(text.getBytes(StandardCharsets.UTF_8), out);
    }

    private static String readText(DataInputView in) throws IOException {
        return new String(readBytes(in), StandardCharsets.UTF_8);
    }

    private static void writeBytes(byte[] bytes, DataOutputView out) throws IOException {
        if (bytes == null) {
            out.writeInt(NOTHING);
        } else {
            out.writeInt(bytes.length);
            out.write(bytes);
        }
    }

    private static byte[] readBytes(DataInputView in) throws IOException {
        int length = in.readInt();
        if (length == NOTHING) {
            return null;
        }
        byte[] bytes = new byte[length];
        in.readFully(bytes);
        return bytes;
    }

    /** Of a record that is copied without being read. */
    @Override
    public void copy(DataInputView from, DataOutputView to) throws IOException {
        serialize(deserialize(from), to);
    }

    /** Nobody changes a record's bytes or headers. */
    @Override
    public boolean isImmutableType() {
        return true;
    }

    @Override
    public TopicRecord copy(TopicRecord record) {
        return record;
    }

    @Override
    public TopicRecord copy(TopicRecord record, TopicRecord reuse) {
        return record;
    }

    @Override
    public TopicRecord deserialize(TopicRecord reuse, DataInputView in) throws IOException {
        return deserialize(in);
    }

    @Override
    public TopicRecord createInstance() {
        return new TopicRecord("", NOTHING, NOTHING, 0, null, null, Map.of());
    }

    @Override
    public TypeSerializer<TopicRecord> duplicate() {
        return this;
    }

    @Override
    public int getLength() {
        return -1; // varies
    }

    @Override
    public boolean equals(Object other) {
        return other instanceof TopicRecordSerializer;
    }

    @Override
    public int hashCode() {
        return TopicRecordSerializer.class.hashCode();
    }

    @Override
    public TypeSerializerSnapshot<TopicRecord> snapshotConfiguration() {
        return new TopicRecordSerializerSnapshot();
    }
}
