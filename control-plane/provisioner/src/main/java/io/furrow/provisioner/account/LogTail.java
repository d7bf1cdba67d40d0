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
 * Reads the lines that are appended to a file, and goes on when the file was renamed or truncated: what was written in between is
 * read too where the renamed file still exists. Begins a few megabytes before the end. For one thread.
 */
final class LogTail {
    /** At most so much is read at once; the rest with the next call. */
    private static final int MAX_BYTES = 4 * 1024 * 1024;

    private final Path file;
    private SeekableByteChannel open;
    private Object key;
    private boolean inLine;

    LogTail(Path file) {
        this.file = file;
    }

    /**
     * Reads complete lines. A file that is missing has none.
     *
     * @throws IOException if the file is there and cannot be read
     */
    void read(Consumer<String> lines) throws IOException {
        boolean first = key == null;
        Object now = key();
        boolean other = now != null && !now.equals(key);
        boolean more = open != null && readOn(lines);
        while (other && more) {
            more = readOn(lines);
        }
        if (other) {
            close();
            open = Files.newByteChannel(file);
            key = now;
            if (first && open.size() > MAX_BYTES) {
                open.position(open.size() - MAX_BYTES);
                inLine = true;
            }
            readOn(lines);
        }
    }

    /** What tells the file from another of its name; null if there is none. */
    private Object key() throws IOException {
        try {
            BasicFileAttributes attributes = Files.readAttributes(file, BasicFileAttributes.class);
            return attributes.fileKey() == null ? file : attributes.fileKey();
        } catch (NoSuchFileException e) {
            return null;
        }
    }

    /** Returns whether there was anything to read. */
    private boolean readOn(Consumer<String> lines) throws IOException {
        if (open.size() < open.position()) {
            open.position(0);
            inLine = false;
        }
        long begin = open.position();
        ByteBuffer buffer = ByteBuffer.allocate((int) Math.min(MAX_BYTES, open.size() - begin));
        while (buffer.hasRemaining() && open.read(buffer) >= 0) {
            // until it is full or the file ends
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
        if (from == 0 && buffer.position() == MAX_BYTES) { // a line that no broker logs
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
