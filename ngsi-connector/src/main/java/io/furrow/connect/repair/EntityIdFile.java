package io.furrow.connect.repair;

import java.io.BufferedReader;
import java.io.BufferedWriter;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.function.Consumer;
import java.util.regex.Pattern;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.core.json.JsonWriteFeature;
import com.fasterxml.jackson.databind.DeserializationFeature;
import com.fasterxml.jackson.databind.ObjectMapper;
import com.fasterxml.jackson.databind.json.JsonMapper;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.journal.DurableFiles;

/**
 * Stores the status of entities as a file of lines: the sign of a kind and the identity as a JSON string. An unfinished
 * or damaged line is skipped. The caller must lock.
 */
final class EntityIdFile implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(EntityIdFile.class);

    /** Escapes everything that UTF-8 cannot encode, such as half a surrogate pair. */
    private static final ObjectMapper JSON = JsonMapper.builder()
            .enable(JsonWriteFeature.ESCAPE_NON_ASCII)
            .enable(DeserializationFeature.FAIL_ON_TRAILING_TOKENS)
            .build();

    private static final Pattern IDENTITY = Pattern.compile("(?s)[^|]*\\|[^|]*\\|[^|]*\\|.*");
    private static final long SMALL = 1024 * 1024;

    /** A line. */
    record Change(Kind kind, String identity) {
        static final Change SETTLED = new Change(Kind.SETTLED, "|||");

        enum Kind {
            ADDED,
            REMOVED,
            /** The entity has to be read again. */
            STALE,
            /** No entity has to be read again any more. */
            SETTLED,
            /** There are more entities than can be stored. */
            TOO_MANY;

            private static final String SIGNS = "+-?.!";
        }

        /** @param maxBytes that do not hold the entities */
        static Change tooMany(long maxBytes) {
            return new Change(Kind.TOO_MANY, "|||" + maxBytes);
        }

        /** Whether the entities did not even fit into as many bytes. */
        boolean isTooManyFor(long maxBytes) {
            return !identity.equals("|||") && Long.parseLong(identity.substring(3)) >= maxBytes;
        }

        private String line() throws IOException {
            return Kind.SIGNS.charAt(kind.ordinal()) + JSON.writeValueAsString(identity) + "\n";
        }

        private static Optional<Change> of(String line) {
            int kind = line.isEmpty() ? -1 : Kind.SIGNS.indexOf(line.charAt(0));
            try {
                String identity = kind < 0 ? "" : String.valueOf(JSON.readValue(line.substring(1), String.class));
                return IDENTITY.matcher(identity).matches()
                        ? Optional.of(new Change(Kind.values()[kind], identity))
                        : Optional.empty();
            } catch (JsonProcessingException e) {
                return Optional.empty();
            }
        }
    }

    private final Path path;
    private BufferedWriter out;
    private long chars;
    private volatile long flushed;
    private long synced;
    /** Changes that arrive while the file is compacted; else null. */
    private List<Change> meanwhile;

    private EntityIdFile(Path path) {
        this.path = path;
    }

    /** Passes all complete lines in order. */
    static void read(Path path, Consumer<Change> reader) throws IOException {
        if (!Files.exists(path)) {
            return;
        }
        long damaged = 0;
        try (BufferedReader in = Files.newBufferedReader(path, StandardCharsets.ISO_8859_1)) {
            for (String line = in.readLine(); line != null; line = in.readLine()) {
                Optional<Change> change = Change.of(line);
                change.ifPresent(reader);
                damaged += change.isEmpty() ? 1 : 0;
            }
        }
        if (damaged > 0) {
            LOG.info(
                    "{} lines of {} are damaged and skipped: the deletions of their entities are only found if they are"
                            + " notified",
                    damaged,
                    path);
        }
    }

    /** Creates the file with exactly these lines. */
    static EntityIdFile write(Path path, Iterable<Change> changes) throws IOException {
        EntityIdFile file = new EntityIdFile(path);
        file.beginRewrite();
        file.writeAside(changes);
        file.endRewrite();
        return file;
    }

    void append(Change change) throws IOException {
        String line = change.line();
        out.write(line);
        chars += line.length();
        if (meanwhile != null) {
            meanwhile.add(change);
        }
    }

    void flush() throws IOException {
        out.flush();
        flushed = chars;
    }

    /** Makes the flushed lines durable. May run while changes are appended. */
    void sync() throws IOException {
        long now = flushed;
        if (now != synced) {
            DurableFiles.sync(path);
            synced = now;
        }
    }

    /** Whether the file is several times larger than necessary. */
    boolean isWasteful(long bytes) {
        return meanwhile == null && chars > SMALL && chars > 2 * bytes;
    }

    void beginRewrite() {
        meanwhile = new ArrayList<>();
    }

    /** May run while changes are appended. */
    void writeAside(Iterable<Change> changes) throws IOException {
        try (BufferedWriter next = Files.newBufferedWriter(aside())) {
            for (Change change : changes) {
                next.write(change.line());
            }
        }
        DurableFiles.sync(aside());
    }

    void endRewrite() throws IOException {
        BufferedWriter before = out;
        BufferedWriter next = Files.newBufferedWriter(aside(), StandardCharsets.UTF_8, StandardOpenOption.APPEND);
        try {
            for (Change change : meanwhile) {
                next.write(change.line());
            }
            next.flush();
            DurableFiles.replace(path, aside());
        } catch (IOException e) {
            next.close();
            throw e;
        }
        out = next;
        meanwhile = null;
        chars = Files.size(path);
        flushed = chars;
        synced = chars;
        if (before != null) {
            before.close();
        }
    }

    /** Discards the rewritten file, for instance because the disk is full. */
    void abandonRewrite() {
        meanwhile = null;
    }

    private Path aside() {
        return path.resolveSibling(path.getFileName() + ".tmp");
    }

    @Override
    public void close() throws IOException {
        out.close();
    }
}
