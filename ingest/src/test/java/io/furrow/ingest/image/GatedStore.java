package io.furrow.ingest.image;

import java.io.IOException;
import java.net.URI;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.AtomicInteger;

import org.apache.flink.core.fs.FSDataOutputStream;
import org.apache.flink.core.fs.FileStatus;
import org.apache.flink.core.fs.FileSystem;
import org.apache.flink.core.fs.FileSystemFactory;
import org.apache.flink.core.fs.Path;
import org.apache.flink.core.fs.local.LocalFileSystem;

/**
 * The local file system under the scheme {@code gated}: a test says for which names a write waits, and how many writes fail.
 */
public final class GatedStore implements FileSystemFactory {
    static final String SCHEME = "gated";

    private static final Map<String, Gate> GATES = new ConcurrentHashMap<>();

    /** The gate of the store below a folder. */
    static Gate below(java.nio.file.Path folder) {
        return GATES.computeIfAbsent(folder.toString(), name -> new Gate());
    }

    static String uri(java.nio.file.Path folder) {
        return SCHEME + "://" + folder;
    }

    /** What a test controls. */
    static final class Gate {
        final AtomicInteger failures = new AtomicInteger();
        final AtomicInteger writes = new AtomicInteger();
        private String closedFor;

        /** Writes to paths that hold this wait until it is opened. */
        synchronized void close(String part) {
            closedFor = part;
            notifyAll();
        }

        synchronized void open() {
            closedFor = null;
            notifyAll();
        }

        private synchronized void pass(Path path) throws IOException {
            while (closedFor != null && path.getPath().contains(closedFor)) {
                try {
                    wait();
                } catch (InterruptedException e) {
                    throw new java.io.InterruptedIOException("the writer was stopped");
                }
            }
            if (failures.getAndUpdate(left -> Math.max(0, left - 1)) > 0) {
                throw new IOException("the store is away");
            }
            writes.incrementAndGet();
        }
    }

    @Override
    public String getScheme() {
        return SCHEME;
    }

    @Override
    public FileSystem create(URI uri) {
        return new LocalFileSystem() {
            @Override
            public FileStatus getFileStatus(Path path) throws IOException {
                return super.getFileStatus(local(path));
            }

            @Override
            public org.apache.flink.core.fs.FSDataInputStream open(Path path) throws IOException {
                return super.open(local(path));
            }

            @Override
            public boolean delete(Path path, boolean recursive) throws IOException {
                return super.delete(local(path), recursive);
            }

            @Override
            public boolean rename(Path from, Path to) throws IOException {
                return super.rename(local(from), local(to));
            }

            @Override
            public FSDataOutputStream create(Path path, WriteMode mode) throws IOException {
                GATES.entrySet().stream()
                        .filter(gate -> path.getPath().startsWith(gate.getKey()))
                        .findFirst()
                        .orElseThrow()
                        .getValue()
                        .pass(path);
                return super.create(local(path), mode);
            }
        };
    }

    private static Path local(Path path) {
        return new Path(path.getPath());
    }
}
