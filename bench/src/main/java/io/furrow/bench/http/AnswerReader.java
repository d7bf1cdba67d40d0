package io.furrow.bench.http;

import java.io.EOFException;
import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.channels.SocketChannel;
import java.nio.charset.StandardCharsets;

/** Reads HTTP/1.1 answers with a {@code Content-Length} (or none: then without a body), one after the other. */
final class AnswerReader {
    private static final int LARGEST = 16 * 1024;
    private static final int STATUS_AT = "HTTP/1.1 ".length();
    private static final byte[] LENGTH = "content-length:".getBytes(StandardCharsets.US_ASCII);
    private static final byte[] CLOSE = "connection: close".getBytes(StandardCharsets.US_ASCII);

    private final ByteBuffer buffer = ByteBuffer.allocate(LARGEST);
    private int status;
    private boolean last;

    /** For a new connection. */
    void reset() {
        buffer.clear();
    }

    /**
     * Reads what is there.
     *
     * @return whether the answer is complete
     * @throws EOFException if the server closed the connection instead
     */
    boolean read(SocketChannel channel) throws IOException {
        if (channel.read(buffer) < 0) {
            throw new EOFException("the connection was closed before the answer");
        }
        int head = headLength();
        if (head < 0) {
            if (!buffer.hasRemaining()) {
                throw new IOException("the answer is longer than " + LARGEST + " bytes");
            }
            return false;
        }
        int whole = head + contentLength(head);
        if (whole > LARGEST) {
            throw new IOException("the answer is longer than " + LARGEST + " bytes");
        }
        if (buffer.position() < whole) {
            return false;
        }
        byte[] bytes = buffer.array();
        status = (bytes[STATUS_AT] - '0') * 100 + (bytes[STATUS_AT + 1] - '0') * 10 + bytes[STATUS_AT + 2] - '0';
        last = find(CLOSE, head) >= 0;
        buffer.clear();
        return true;
    }

    /** Of the answer just read. */
    int status() {
        return status;
    }

    /** Whether the server closes the connection behind the answer just read. */
    boolean isLast() {
        return last;
    }

    private int headLength() {
        byte[] bytes = buffer.array();
        for (int i = 3; i < buffer.position(); i++) {
            if (bytes[i] == '\n' && bytes[i - 1] == '\r' && bytes[i - 2] == '\n') {
                return i + 1;
            }
        }
        return -1;
    }

    private int contentLength(int head) {
        int at = find(LENGTH, head);
        if (at < 0) {
            return 0;
        }
        byte[] bytes = buffer.array();
        int length = 0;
        for (int i = at + LENGTH.length; bytes[i] != '\r'; i++) {
            if (bytes[i] >= '0' && bytes[i] <= '9') {
                length = length * 10 + bytes[i] - '0';
            }
        }
        return length;
    }

    /** Where a lower-case text is at the start of a header line, whatever its case there; -1 for nowhere. */
    private int find(byte[] desired, int head) {
        byte[] bytes = buffer.array();
        for (int i = 1; i < head - desired.length; i++) {
            if (bytes[i - 1] == '\n' && matches(bytes, i, desired)) {
                return i;
            }
        }
        return -1;
    }

    private static boolean matches(byte[] bytes, int at, byte[] desired) {
        for (int i = 0; i < desired.length; i++) {
            byte found = bytes[at + i];
            int lower = found >= 'A' && found <= 'Z' ? found + ('a' - 'A') : found;
            if (lower != desired[i]) {
                return false;
            }
        }
        return true;
    }
}
