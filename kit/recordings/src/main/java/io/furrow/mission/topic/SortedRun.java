package io.furrow.mission.topic;

import java.io.BufferedInputStream;
import java.io.BufferedOutputStream;
import java.io.DataInputStream;
import java.io.DataOutputStream;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;

/** Reads a file of sorted events: a flag precedes each event and ends the file. */
final class SortedRun implements AutoCloseable {
    private static final int BUFFER = 64 * 1024;

    private final DataInputStream in;
    private SortedEvent head;

    SortedRun(Path file) throws IOException {
        in = new DataInputStream(new BufferedInputStream(Files.newInputStream(file), BUFFER));
        remove();
    }

    static DataOutputStream create(Path file) throws IOException {
        return new DataOutputStream(new BufferedOutputStream(Files.newOutputStream(file), BUFFER));
    }

    static void write(SortedEvent event, DataOutputStream out) throws IOException {
        out.writeBoolean(true);
        event.write(out);
    }

    static void end(DataOutputStream out) throws IOException {
        out.writeBoolean(false);
    }

    /** Returns the next event without consuming it; null at the end. */
    SortedEvent peek() {
        return head;
    }

    /** Consumes the event of {@link #peek}. */
    void remove() throws IOException {
        head = in.readBoolean() ? SortedEvent.read(in) : null;
    }

    @Override
    public void close() throws IOException {
        in.close();
    }
}
