package io.furrow.mission.export;

import java.io.ByteArrayOutputStream;
import java.nio.charset.StandardCharsets;
import java.util.Map;
import java.util.SortedMap;

/**
 * Serializes the content of an MCAP record: numbers in little-endian order, texts and maps after their length in bytes.
 */
final class McapBuffer {
    private final ByteArrayOutputStream bytes = new ByteArrayOutputStream();

    McapBuffer u8(int value) {
        return number(value, Byte.BYTES);
    }

    McapBuffer u16(int value) {
        return number(value, Short.BYTES);
    }

    McapBuffer u32(long value) {
        return number(value, Integer.BYTES);
    }

    McapBuffer u64(long value) {
        return number(value, Long.BYTES);
    }

    private McapBuffer number(long value, int width) {
        for (int shift = 0; shift < width * Byte.SIZE; shift += Byte.SIZE) {
            bytes.write((int) (value >>> shift));
        }
        return this;
    }

    McapBuffer text(String text) {
        return prefixed(text.getBytes(StandardCharsets.UTF_8));
    }

    /** Writes bytes after their 32-bit length. */
    McapBuffer prefixed(byte[] content) {
        return u32(content.length).raw(content);
    }

    McapBuffer raw(byte[] content) {
        bytes.writeBytes(content);
        return this;
    }

    McapBuffer texts(SortedMap<String, String> map) {
        McapBuffer entries = new McapBuffer();
        map.forEach((name, value) -> entries.text(name).text(value));
        return prefixed(entries.toArray());
    }

    /** Writes a map from channel ids to counts or offsets. */
    McapBuffer byChannel(SortedMap<Integer, Long> map) {
        McapBuffer entries = new McapBuffer();
        for (Map.Entry<Integer, Long> entry : map.entrySet()) {
            entries.u16(entry.getKey()).u64(entry.getValue());
        }
        return prefixed(entries.toArray());
    }

    /** Writes opcode, length and content. */
    McapBuffer record(McapWriter.Opcode opcode, McapBuffer content) {
        byte[] array = content.toArray();
        return u8(opcode.code()).u64(array.length).raw(array);
    }

    int size() {
        return bytes.size();
    }

    byte[] toArray() {
        return bytes.toByteArray();
    }
}
