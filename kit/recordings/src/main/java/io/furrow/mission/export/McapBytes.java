package io.furrow.mission.export;

import java.io.ByteArrayOutputStream;
import java.nio.charset.StandardCharsets;
import java.util.Map;
import java.util.SortedMap;

/** The content of a record as MCAP serializes it: numbers with the least byte first, texts and maps after their length in bytes. */
final class McapBytes {
    private final ByteArrayOutputStream bytes = new ByteArrayOutputStream();

    McapBytes u8(int value) {
        return number(value, Byte.BYTES);
    }

    McapBytes u16(int value) {
        return number(value, Short.BYTES);
    }

    McapBytes u32(long value) {
        return number(value, Integer.BYTES);
    }

    McapBytes u64(long value) {
        return number(value, Long.BYTES);
    }

    private McapBytes number(long value, int width) {
        for (int shift = 0; shift < width * Byte.SIZE; shift += Byte.SIZE) {
            bytes.write((int) (value >>> shift));
        }
        return this;
    }

    McapBytes text(String text) {
        return prefixed(text.getBytes(StandardCharsets.UTF_8));
    }

    /** After their length as 32 bits. */
    McapBytes prefixed(byte[] content) {
        return u32(content.length).raw(content);
    }

    McapBytes raw(byte[] content) {
        bytes.writeBytes(content);
        return this;
    }

    McapBytes texts(SortedMap<String, String> map) {
        McapBytes entries = new McapBytes();
        map.forEach((name, value) -> entries.text(name).text(value));
        return prefixed(entries.toArray());
    }

    /** From channel ids to counts or offsets. */
    McapBytes byChannel(SortedMap<Integer, Long> map) {
        McapBytes entries = new McapBytes();
        for (Map.Entry<Integer, Long> entry : map.entrySet()) {
            entries.u16(entry.getKey()).u64(entry.getValue());
        }
        return prefixed(entries.toArray());
    }

    /** Opcode, length, content. */
    McapBytes record(McapWriter.Opcode opcode, McapBytes content) {
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
