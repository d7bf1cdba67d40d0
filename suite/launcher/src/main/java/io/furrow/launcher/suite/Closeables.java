package io.furrow.launcher.suite;

import java.util.ArrayDeque;
import java.util.Deque;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** Started parts, to be stopped in reverse order; a part that fails to stop does not prevent the others. */
public final class Closeables implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(Closeables.class);

    private final Deque<Part> started = new ArrayDeque<>();
    private boolean closed;

    private record Part(String name, AutoCloseable closeable) {}

    /** @throws IllegalStateException if these parts have been closed; the part is closed then, too */
    public synchronized <T extends AutoCloseable> T add(String name, T part) {
        started.push(new Part(name, part));
        if (closed) {
            close();
            throw new IllegalStateException(name + " came up while everything stops");
        }
        return part;
    }

    @Override
    public synchronized void close() {
        closed = true;
        while (!started.isEmpty()) {
            Part part = started.pop();
            try {
                part.closeable().close();
            } catch (Exception e) { // AutoCloseable declares no narrower type
                LOG.warn("{} did not stop cleanly", part.name(), e);
            }
        }
    }
}
