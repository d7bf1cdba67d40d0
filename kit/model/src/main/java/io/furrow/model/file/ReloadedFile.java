package io.furrow.model.file;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import java.nio.file.attribute.BasicFileAttributes;
import java.nio.file.attribute.FileTime;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.locks.ReentrantLock;
import java.util.function.Consumer;
import java.util.function.Supplier;

/**
 * Reloads files after changes. Invalid files leave the last valid content in place; this is reported once, and the
 * files are tried again. The files are checked on access to the content, at most once a second. Thread-safe.
 *
 * @param <T> the content of the files
 */
public final class ReloadedFile<T> implements Supplier<T> {
    private static final Duration CHECK_INTERVAL = Duration.ofSeconds(1);

    private final List<Path> files;
    private final Source<T> source;
    private final Consumer<String> warning;
    private final long intervalNanos;
    private final ReentrantLock reloading = new ReentrantLock();
    private volatile T content;
    private volatile String problem;
    private volatile long checked;
    private List<Stamp> stamps;

    /**
     * Reads the content of the files.
     *
     * @param <T> the content
     */
    @FunctionalInterface
    public interface Source<T> {
        /** @throws IOException if the files are invalid; the message names the file, what is wrong and what to do */
        T read() throws IOException;
    }

    /** Identifies a state of a file, also if it is replaced by a link to another one. */
    private record Stamp(FileTime modified, long bytes, Object file) {
        static Stamp of(Path file) throws IOException {
            try {
                BasicFileAttributes attributes = Files.readAttributes(file, BasicFileAttributes.class);
                return new Stamp(attributes.lastModifiedTime(), attributes.size(), attributes.fileKey());
            } catch (NoSuchFileException e) { // the source reports missing files
                return new Stamp(null, 0, null);
            }
        }
    }

    private ReloadedFile(List<Path> files, Source<T> source, Consumer<String> warning, Duration interval) {
        this.files = files;
        this.source = source;
        this.warning = warning;
        this.intervalNanos = interval.toNanos();
    }

    /**
     * Reads the files for the first time.
     *
     * @param warning receives a message whenever changed files are invalid
     * @throws IOException of the source
     */
    public static <T> ReloadedFile<T> open(List<Path> files, Source<T> source, Consumer<String> warning)
            throws IOException {
        return open(files, source, warning, CHECK_INTERVAL);
    }

    static <T> ReloadedFile<T> open(List<Path> files, Source<T> source, Consumer<String> warning, Duration interval)
            throws IOException {
        ReloadedFile<T> opened = new ReloadedFile<>(files, source, warning, interval);
        opened.stamps = stamps(files);
        opened.content = opened.read();
        opened.checked = System.nanoTime();
        return opened;
    }

    /** Returns the newest valid content. */
    @Override
    public T get() {
        boolean due = System.nanoTime() - checked >= intervalNanos;
        if (due && reloading.tryLock()) {
            try {
                reload();
            } finally {
                reloading.unlock();
            }
        }
        return content;
    }

    /** Returns why the files were invalid at the last check; empty if they are in use. */
    public Optional<String> problem() {
        return Optional.ofNullable(problem);
    }

    private void reload() {
        try {
            List<Stamp> now = stamps(files);
            if (problem != null || !now.equals(stamps)) {
                content = read();
                stamps = now;
                problem = null;
            }
        } catch (IOException e) {
            if (!e.getMessage().equals(problem)) {
                warning.accept(e.getMessage() + "; the content from before stays in use");
            }
            problem = e.getMessage();
        }
        checked = System.nanoTime();
    }

    private T read() throws IOException {
        try {
            return source.read();
        } catch (NoSuchFileException e) {
            throw new IOException("there is no file " + e.getFile(), e);
        }
    }

    private static List<Stamp> stamps(List<Path> files) throws IOException {
        List<Stamp> stamps = new ArrayList<>();
        for (Path file : files) {
            stamps.add(Stamp.of(file));
        }
        return stamps;
    }
}
