package io.furrow.provisioner.account;

import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.channels.SeekableByteChannel;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import java.nio.file.attribute.BasicFileAttributes;
import java.util.function.Consumer;

/**
 * Reads the lines that are appended to a file, and follows it when it is renamed or truncated: the rest of a renamed
 * file is read too, if it still exists. Starts a few megabytes before the end. Not thread-safe.
 */
final class LogTail {
    /** Maximum number of bytes read at once. */
    private static final int MAX_BYTES = 4 * 1024 * 1024;

    private final Path file;
    private SeekableByteChannel open;
    private Object key;
    private boolean inLine;

    LogTail(Path file) {
        this.file = file;
    }

    /**
     * Reads the complete lines since the previous call. A missing file has none.
     *
     * @throws IOException if the file exists but cannot be read
     */
    void read(Consumer<String> lines) throws IOException {
        boolean first = key == null;
        Object now = key();
        boolean replaced = now != null && !now.equals(key);
        boolean more = open != null && readMore(lines);
        while (replaced && more) {
            more = readMore(lines);
        }
        if (replaced) {
            close();
            open = Files.newByteChannel(file);
            key = now;
            if (first && open.size() > MAX_BYTES) {
                open.position(open.size() - MAX_BYTES);
                inLine = true;
            }
            readMore(lines);
        }
    }

    /** Returns the identity of the file, which distinguishes it from its successor; null if it does not exist. */
    private Object key() throws IOException {
        try {
            BasicFileAttributes attributes = Files.readAttributes(file, BasicFileAttributes.class);
            return attributes.fileKey() == null ? file : attributes.fileKey();
        } catch (NoSuchFileException e) {
            return null;
        }
    }

    /** Returns whether complete lines were read. */
    private boolean readMore(Consumer<String> lines) throws IOException {
        if (open.size() < open.position()) {
            open.position(0);
            inLine = false;
        }
        long begin = open.position();
        ByteBuffer buffer = ByteBuffer.allocate((int) Math.min(MAX_BYTES, open.size() - begin));
        while (buffer.hasRemaining() && open.read(buffer) >= 0) {
            // continues until the buffer is full or the file ends
        }
        byte[] bytes = buffer.array();
        int from = 0;
        for (int i = 0; i < buffer.position(); i++) {
            if (bytes[i] == '\n') {
                if (!inLine) {
                    lines.accept(new String(bytes, from, i - from, StandardCharsets.UTF_8));
                }
                inLine = false;
                from = i + 1;
            }
        }
        if (from == 0 && buffer.position() == MAX_BYTES) { // longer than any line of a broker
            inLine = true;
            from = MAX_BYTES;
        }
        open.position(begin + from);
        return from > 0;
    }

    private void close() throws IOException {
        if (open != null) {
            open.close();
            open = null;
        }
        inLine = false;
    }
}
