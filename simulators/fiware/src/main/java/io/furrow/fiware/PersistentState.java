package io.furrow.fiware;

import java.io.EOFException;
import java.io.FileOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.time.Duration;
import java.util.concurrent.Executors;
import java.util.concurrent.ScheduledExecutorService;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicLong;
import java.util.zip.Deflater;
import java.util.zip.GZIPInputStream;
import java.util.zip.GZIPOutputStream;
import java.util.zip.ZipException;

import com.fasterxml.jackson.core.JsonFactory;
import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.core.StreamReadConstraints;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.MappingIterator;
import com.fasterxml.jackson.databind.RuntimeJsonMappingException;
import com.fasterxml.jackson.databind.SequenceWriter;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.fiware.http.NgsiError;
import io.furrow.model.ngsi.JsonProblem;
import io.furrow.model.ngsi.NgsiJson;

/**
 * Persists the state of a stand-in in a file: reads it once, writes it seconds after a change and on close. The file is gzip over
 * one JSON object per line, first {@code {"fiwareState": <version>}}, last {@code {"end": <count>}}; it is replaced atomically.
 */
final class PersistentState implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(PersistentState.class);
    private static final Duration INTERVAL = Duration.ofSeconds(5);
    private static final long CLOSE_SECONDS = 30;
    private static final String VERSION_FIELD = "fiwareState";
    private static final int VERSION = 1;
    private static final String END_FIELD = "end";
    private static final int BUFFER = 64 * 1024;

    /** A line wraps a document of a request, so it may be a little deeper. */
    private static final JsonFactory DEEPER = JsonFactory.builder()
            .streamReadConstraints(StreamReadConstraints.builder()
                    .maxNestingDepth(NgsiJson.MAX_NESTING + 8)
                    .maxStringLength(NgsiJson.MAX_STRING)
                    .build())
            .build();

    private final Path file;
    private final StateCodec state;
    private final AtomicLong revision;
    private final ScheduledExecutorService writer = Executors.newSingleThreadScheduledExecutor(PersistentState::thread);
    private long saved;
    private boolean failing;

    /**
     * Restores the state from the file, if it exists, and writes it again after changes.
     *
     * @param revision incremented with every change of the state
     * @throws IllegalStateException if the file is damaged
     * @throws UncheckedIOException if it cannot be read
     */
    static PersistentState open(Path path, StateCodec state, AtomicLong revision) {
        Path file = path.toAbsolutePath();
        try {
            if (Files.exists(file)) {
                read(file, state);
            }
        } catch (EOFException
                | ZipException
                | JsonProcessingException
                | RuntimeJsonMappingException
                | IllegalArgumentException
                | NgsiError e) {
            throw new IllegalStateException(
                    "the FIWARE stand-in cannot start from its state in " + file + ", the file is damaged ("
                            + (e instanceof IOException read ? JsonProblem.of(read) : e.getMessage())
                            + "); restore a copy, or move it away to start without state",
                    e);
        } catch (IOException e) {
            throw new UncheckedIOException(
                    "the FIWARE stand-in cannot read its state in " + file + "; may this user read it?", e);
        }
        return new PersistentState(file, state, revision);
    }

    private PersistentState(Path file, StateCodec state, AtomicLong revision) {
        this.file = file;
        this.state = state;
        this.revision = revision;
        saved = revision.get();
        writer.scheduleWithFixedDelay(this::save, INTERVAL.toMillis(), INTERVAL.toMillis(), TimeUnit.MILLISECONDS);
    }

    private static void read(Path file, StateCodec state) throws IOException, NgsiError {
        try (InputStream in = new GZIPInputStream(Files.newInputStream(file), BUFFER);
                JsonParser parser = DEEPER.createParser(in);
                MappingIterator<JsonNode> lines =
                        NgsiJson.mapper().readerFor(JsonNode.class).readValues(parser)) {
            int version =
                    lines.hasNextValue() ? lines.nextValue().path(VERSION_FIELD).asInt() : 0;
            require(version == VERSION, "it is of version " + version + ", not " + VERSION);
            boolean ended = false;
            int count = 0;
            // Read to the end of the file, where its checksum is.
            while (lines.hasNextValue()) {
                JsonNode line = lines.nextValue();
                require(!ended, "lines follow its end");
                ended = line.has(END_FIELD);
                if (ended) {
                    require(line.get(END_FIELD).asInt() == count, "lines are missing");
                } else {
                    state.restore(line);
                    count++;
                }
            }
            require(ended, "its end is missing");
        }
    }

    private static void require(boolean intact, String damage) {
        if (!intact) {
            throw new IllegalArgumentException(damage);
        }
    }

    @Override
    public void close() {
        writer.shutdown();
        try {
            if (!writer.awaitTermination(CLOSE_SECONDS, TimeUnit.SECONDS)) {
                LOG.warn("Still writing {}", file);
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
        save();
    }

    private synchronized void save() {
        // Read first: a change during the write is written the next time.
        long now = revision.get();
        if (now == saved) {
            return;
        }
        try {
            write();
            saved = now;
            failing = false;
        } catch (IOException e) {
            if (!failing) {
                LOG.error("The state of the FIWARE stand-in cannot be written to {}; the write is retried", file, e);
            }
            failing = true;
        }
    }

    private void write() throws IOException {
        Files.createDirectories(file.getParent());
        Path temporary = file.resolveSibling(file.getFileName() + ".tmp");
        // Not a channel: an interrupt would close it in the middle.
        try (FileOutputStream out = new FileOutputStream(temporary.toFile());
                FastGzip gzip = new FastGzip(out);
                SequenceWriter lines =
                        NgsiJson.mapper().writer().withRootValueSeparator("\n").writeValues((OutputStream) gzip)) {
            lines.write(JsonNodeFactory.instance.objectNode().put(VERSION_FIELD, VERSION));
            int count = 0;
            for (ObjectNode line : state.lines()) {
                lines.write(line);
                count++;
            }
            lines.write(JsonNodeFactory.instance.objectNode().put(END_FIELD, count));
            lines.flush();
            gzip.finish();
            out.getFD().sync();
        }
        Files.move(temporary, file, StandardCopyOption.ATOMIC_MOVE, StandardCopyOption.REPLACE_EXISTING);
    }

    private static Thread thread(Runnable work) {
        Thread thread = new Thread(work, "furrow-fiware-state");
        thread.setDaemon(true);
        return thread;
    }

    private static final class FastGzip extends GZIPOutputStream {
        private FastGzip(OutputStream out) throws IOException {
            super(out, BUFFER);
            def.setLevel(Deflater.BEST_SPEED);
        }
    }
}
