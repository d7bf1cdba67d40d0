package io.furrow.launcher.suite;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.channels.FileChannel;
import java.nio.channels.FileLock;
import java.nio.channels.OverlappingFileLockException;
import java.nio.file.AccessDeniedException;
import java.nio.file.FileAlreadyExistsException;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.nio.file.attribute.FileAttribute;
import java.nio.file.attribute.PosixFilePermissions;
import java.time.Duration;
import java.util.regex.Pattern;
import java.util.stream.Stream;

import org.apache.kafka.common.utils.Utils;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.cli.option.CommandException;
import io.furrow.launcher.process.Sleep;

/**
 * The directory of one running suite, locked against a second one. A temporary one is deleted when it is closed, and also when the
 * JVM is asked to end (SIGINT, SIGTERM, SIGHUP) before that.
 */
public final class RunDirectory implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(RunDirectory.class);
    private static final int DELETIONS = 100;
    private static final Duration DELETION_INTERVAL = Duration.ofMillis(20);
    private static final String LOCK = "lock";
    /** Files left by a refused start, and those of a separate file system. */
    private static final Pattern WITHOUT_DATA =
            Pattern.compile(Pattern.quote(LOCK) + "|furrow\\.log(\\.\\d+)?|lost\\+found");

    private static final FileAttribute<?> OWNER_ONLY =
            PosixFilePermissions.asFileAttribute(PosixFilePermissions.fromString("rwx------"));

    private final Path path;
    private final boolean temporary;
    private final boolean fresh;
    private final FileChannel lock;
    private final Closeables writers = new Closeables();
    private final Thread atShutdown = new Thread(this::closeAtShutdown, "delete");

    private RunDirectory(Path path, boolean temporary, boolean fresh, FileChannel lock) {
        this.path = path;
        this.temporary = temporary;
        this.fresh = fresh;
        this.lock = lock;
        if (temporary) {
            Runtime.getRuntime().addShutdownHook(atShutdown);
        }
    }

    /**
     * @param retained null for a temporary directory
     * @throws CommandException if it cannot be written or another suite uses it
     */
    public static RunDirectory open(Path retained) {
        if (retained != null && retained.toAbsolutePath().toString().contains(",")) {
            throw new CommandException(
                    "--data %s has a comma in its path, at which Kafka would divide it. Name another directory."
                            .formatted(retained));
        }
        try {
            Path path = retained == null ? Files.createTempDirectory("furrow-") : make(retained.toAbsolutePath());
            FileChannel lock = lock(path);
            return new RunDirectory(path, retained == null, isFresh(path), lock);
        } catch (IOException e) {
            throw new CommandException(
                    "Cannot write in %s (%s). Name a directory that you may write with --data."
                            .formatted(retained == null ? System.getProperty("java.io.tmpdir") : retained, reason(e)),
                    e);
        }
    }

    /** Java's messages consist of the path alone. */
    private static String reason(IOException e) {
        if (e instanceof FileAlreadyExistsException) {
            return e.getMessage() + " is not a directory";
        } else if (e instanceof AccessDeniedException) {
            return "no permission for " + e.getMessage();
        }
        return e instanceof NoSuchFileException ? "there is no " + e.getMessage() : e.getMessage();
    }

    /** Stored data includes passwords and API keys of devices, so that a new directory is private. */
    private static Path make(Path directory) throws IOException {
        if (Files.isDirectory(directory)) {
            return directory;
        }
        Files.createDirectories(directory.getParent());
        boolean posix = directory.getFileSystem().supportedFileAttributeViews().contains("posix");
        return posix ? Files.createDirectory(directory, OWNER_ONLY) : Files.createDirectory(directory);
    }

    public Path path() {
        return path;
    }

    public Path resolve(String name) {
        return path.resolve(name);
    }

    boolean isTemporary() {
        return temporary;
    }

    /** Closes a part that writes here before the directory is deleted in the JVM's shutdown, the newest part first. */
    public <T extends AutoCloseable> T closingFirst(T part) {
        return writers.add("what writes to " + path, part);
    }

    /** For an owner with a shutdown hook that closes this directory. */
    public void leaveToItsOwner() {
        forgetShutdown();
    }

    private void closeAtShutdown() {
        writers.close();
        close();
    }

    private void forgetShutdown() {
        try {
            Runtime.getRuntime().removeShutdownHook(atShutdown);
        } catch (IllegalStateException e) {
            LOG.debug("the JVM shuts down already", e);
        }
    }

    /** Whether no earlier suite has stored anything in it. */
    boolean isFresh() {
        return fresh;
    }

    private static boolean isFresh(Path directory) throws IOException {
        try (Stream<Path> files = Files.list(directory)) {
            return files.allMatch(
                    file -> WITHOUT_DATA.matcher(file.getFileName().toString()).matches());
        }
    }

    @Override
    public void close() {
        forgetShutdown();
        try {
            lock.close();
            if (temporary) {
                delete();
            }
        } catch (IOException e) {
            throw new UncheckedIOException("cannot delete " + path, e);
        }
    }

    private static FileChannel lock(Path directory) throws IOException {
        FileChannel channel =
                FileChannel.open(directory.resolve(LOCK), StandardOpenOption.CREATE, StandardOpenOption.WRITE);
        FileLock lock;
        try {
            lock = channel.tryLock();
        } catch (OverlappingFileLockException e) {
            lock = null; // held by this very process
        }
        if (lock == null) {
            channel.close();
            throw new CommandException(
                    "Another Furrow uses " + directory + ". Stop it, or name another directory with --data.");
        }
        return channel;
    }

    /** Repeats while a part that has not stopped yet writes or deletes here. */
    private void delete() throws IOException {
        for (int attempt = 1; Files.exists(path); attempt++) {
            try {
                Utils.delete(path.toFile());
            } catch (IOException e) {
                if (attempt == DELETIONS) {
                    throw e;
                }
                Sleep.of(DELETION_INTERVAL);
            }
        }
    }
}
