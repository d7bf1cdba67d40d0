package io.furrow.bench.http;

import java.io.EOFException;
import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.channels.SocketChannel;
import java.nio.charset.StandardCharsets;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/** Reads successive HTTP/1.1 answers with a {@code Content-Length} (without one, there is no body). */
final class AnswerReader {
    private static final int LARGEST = 16 * 1024;
    private static final int STATUS_AT = "HTTP/1.1 ".length();
    private static final String END_OF_HEAD = "\r\n\r\n";
    private static final Pattern LENGTH = Pattern.compile("(?i)\r\ncontent-length: *(\\d{1,9})");
    private static final Pattern CLOSE = Pattern.compile("(?i)\r\nconnection: *close");

    private final ByteBuffer buffer = ByteBuffer.allocate(LARGEST);
    private int status;
    private boolean last;

    /** For a new connection. */
    void reset() {
        buffer.clear();
    }

    /**
     * Reads the available bytes.
     *
     * @return whether the answer is complete
     * @throws EOFException if the server closed the connection instead
     */
    boolean read(SocketChannel channel) throws IOException {
        if (channel.read(buffer) < 0) {
            throw new EOFException("the connection was closed before the answer");
        }
        String text = new String(buffer.array(), 0, buffer.position(), StandardCharsets.ISO_8859_1);
        int head = text.indexOf(END_OF_HEAD);
        Matcher length = LENGTH.matcher(text).region(0, Math.max(0, head));
        int body = length.find() ? Integer.parseInt(length.group(1)) : 0;
        int whole = head < 0 ? text.length() + 1 : head + END_OF_HEAD.length() + body;
        if (whole > LARGEST) {
            throw new IOException("the answer is longer than " + LARGEST + " bytes");
        }
        if (text.length() < whole) {
            return false;
        }
        status = Integer.parseInt(text, STATUS_AT, STATUS_AT + 3, 10);
        last = CLOSE.matcher(text).region(0, head).find();
        buffer.clear();
        return true;
    }

    /** Status of the last answer. */
    int status() {
        return status;
    }

    /** Whether the server closes the connection after the last answer. */
    boolean isLast() {
        return last;
    }
}
