package io.furrow.flink.record;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.util.List;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;
import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.header.internals.RecordHeader;

import io.furrow.flink.format.VersionedSerializer;

/**
 * Serializes a {@link TopicRecord} for other subtasks and for state: the fields in order, fixed-size numbers, texts as
 * UTF-8 after their length, null as length −1. Records are most of the traffic between subtasks, and Flink's own serializer
 * of records writes texts character by character.
 */
public final class TopicRecordSerializer extends VersionedSerializer<TopicRecord> {
    private static final long serialVersionUID = 1L;
    /** Topic, partition, offset, timestamp, key, value, headers. */
    private static final int VERSION = 1;

    private static final int NOTHING = -1;

    @Override
    public Class<TopicRecord> type() {
        return TopicRecord.class;
    }

    @Override
    public int version() {
        return VERSION;
    }

    @Override
    public void write(TopicRecord record, DataOutputView out) throws IOException {
        writeText(record.topic(), out);
        out.writeInt(record.partition());
        out.writeLong(record.offset());
        out.writeLong(record.timestamp());
        writeBytes(record.key(), out);
        writeBytes(record.value(), out);
        List<Header> headers = TextHeaders.of(record.headers()).bytes();
        out.writeInt(headers.size());
        for (Header header : headers) {
            writeText(header.key(), out);
            writeBytes(header.value(), out);
        }
    }

    @Override
    public TopicRecord read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
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
        return new TopicRecord(topic, partition, offset, timestamp, key, value, TextHeaders.of(headers));
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
}
