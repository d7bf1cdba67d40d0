package io.furrow.flink.format;

import java.io.IOException;
import java.nio.charset.StandardCharsets;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

/** Encodes texts in UTF-8 after their length: one byte below 255, else four more. */
public final class StringCodec {
    private static final int LONG = 255;
    private static final int SPREAD = 0x9E3779B9;
    private static final int SHIFT = 14;
    private static final SharedByTasks<String[]> KNOWN =
            new SharedByTasks<>(() -> new String[1 << Integer.SIZE - SHIFT]);

    private StringCodec() {}

    public static void write(String text, DataOutputView out) throws IOException {
        if (text.isEmpty()) {
            out.writeByte(0);
            return;
        }
        byte[] bytes = text.getBytes(StandardCharsets.UTF_8);
        if (bytes.length < LONG) {
            out.writeByte(bytes.length);
        } else {
            out.writeByte(LONG);
            out.writeInt(bytes.length);
        }
        out.write(bytes);
    }

    public static String read(DataInputView in) throws IOException {
        int length = in.readUnsignedByte();
        if (length == 0) {
            return "";
        }
        byte[] bytes = new byte[length == LONG ? in.readInt() : length];
        in.readFully(bytes);
        return shared(new String(bytes, StandardCharsets.UTF_8));
    }

    /** Interns a text in most cases: names recur and are held many times. */
    public static String shared(String text) {
        int slot = text.hashCode() * SPREAD >>> SHIFT;
        String[] all = KNOWN.get();
        String known = all[slot]; // whichever of two threads wrote last
        if (text.equals(known)) {
            return known;
        }
        all[slot] = text;
        return text;
    }
}
