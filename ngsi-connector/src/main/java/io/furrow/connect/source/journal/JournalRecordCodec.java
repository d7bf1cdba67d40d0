package io.furrow.connect.source.journal;

import java.io.ByteArrayInputStream;
import java.io.DataInputStream;
import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.Map;

import io.furrow.connect.record.KafkaRecord;

/**
 * Serializes a record for the journal. Version 1: the version (1 byte), the time in epoch milliseconds (8), topic, key,
 * the number of headers (4), name and value of each header, the value of the record. Texts are UTF-8; texts and values
 * are preceded by their length (4), -1 for null.
 */
public final class JournalRecordCodec {
    private static final int VERSION = 1;
    /**
     * Together with the overhead in {@link KafkaRecord#bytes}, more than the version, the time and the remaining
     * lengths need.
     */
    private static final int ROOM_FOR_LENGTHS = 128;

    private JournalRecordCodec() {}

    public static byte[] write(KafkaRecord record) {
        ByteBuffer out =
                ByteBuffer.allocate((int) record.bytes() + record.topic().length() + ROOM_FOR_LENGTHS);
        out.put((byte) VERSION).putLong(record.time().toEpochMilli());
        write(record.topic(), out);
        write(record.key(), out);
        out.putInt(record.headers().size());
        for (Map.Entry<String, String> header : record.headers().entrySet()) {
            write(header.getKey(), out);
            write(header.getValue(), out);
        }
        write(record.value(), out);
        return Arrays.copyOf(out.array(), out.position());
    }

    /** @throws IllegalArgumentException if the bytes have another version or are not a record */
    public static KafkaRecord read(byte[] bytes) {
        try (DataInputStream in = new DataInputStream(new ByteArrayInputStream(bytes))) {
            int version = in.readByte();
            if (version != VERSION) {
                throw new IllegalArgumentException("a record of version " + version + "; this plugin knows " + VERSION);
            }
            Instant time = Instant.ofEpochMilli(in.readLong());
            String topic = readPresentText(in);
            String key = readText(in);
            Map<String, String> headers = new LinkedHashMap<>();
            for (int left = in.readInt(); left > 0; left--) {
                headers.put(readPresentText(in), readPresentText(in));
            }
            byte[] value = readBytes(in);
            if (in.available() > 0) {
                throw new IllegalArgumentException(in.available() + " bytes too many");
            }
            return new KafkaRecord(topic, key, value, time, headers);
        } catch (IOException e) {
            throw new IllegalArgumentException("a record of version " + VERSION + " ends too early", e);
        }
    }

    private static void write(String text, ByteBuffer out) {
        write(text == null ? null : text.getBytes(StandardCharsets.UTF_8), out);
    }

    private static void write(byte[] bytes, ByteBuffer out) {
        out.putInt(bytes == null ? -1 : bytes.length);
        if (bytes != null) {
            out.put(bytes);
        }
    }

    private static String readPresentText(DataInputStream in) throws IOException {
        String text = readText(in);
        if (text == null) {
            throw new IllegalArgumentException("a topic or header that is null");
        }
        return text;
    }

    private static String readText(DataInputStream in) throws IOException {
        byte[] bytes = readBytes(in);
        return bytes == null ? null : new String(bytes, StandardCharsets.UTF_8);
    }

    private static byte[] readBytes(DataInputStream in) throws IOException {
        int length = in.readInt();
        if (length == -1) {
            return null;
        }
        if (length < 0 || length > in.available()) {
            throw new IllegalArgumentException(
                    "a length of " + length + " where " + in.available() + " bytes are left");
        }
        return in.readNBytes(length);
    }
}
