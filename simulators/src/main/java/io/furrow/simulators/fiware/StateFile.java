package io.furrow.simulators.fiware;

import java.io.EOFException;
import java.io.FileOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
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

import io.furrow.model.ngsi.NgsiJson;

/**
 * JSON objects in a file, gzip over one object a line: first {@code {"fiwareState": <version>}}, last {@code {"end": <count>}}.
 * The file is replaced as a whole or stays as it was.
 */
final class StateFile {
    /** What can be told of a file that cannot be used. */
    static final class DamagedException extends Exception {
        private static final long serialVersionUID = 1L;

        DamagedException(String message, Throwable cause) {
            super(message, cause);
        }
    }

    /** Takes what is read. */
    interface Reader {
        void take(JsonNode line) throws NgsiError;
    }

    private static final String VERSION_FIELD = "fiwareState";
    private static final int VERSION = 1;
    private static final String END_FIELD = "end";
    private static final int BUFFER = 64 * 1024;

    /** The lines wrap what came in as one document of its own, so they may be a little deeper. */
    private static final JsonFactory DEEPER = JsonFactory.builder()
            .streamReadConstraints(StreamReadConstraints.builder()
                    .maxNestingDepth(NgsiJson.MAX_NESTING + 8)
                    .maxStringLength(NgsiJson.MAX_STRING)
                    .build())
            .build();

    private final Path path;

    StateFile(Path path) {
        this.path = path.toAbsolutePath();
    }

    /** Reads nothing where there is no file. */
    void read(Reader reader) throws IOException, DamagedException {
        if (!Files.exists(path)) {
            return;
        }
        try (InputStream in = new GZIPInputStream(Files.newInputStream(path), BUFFER);
                JsonParser parser = DEEPER.createParser(in);
                MappingIterator<JsonNode> lines =
                        NgsiJson.mapper().readerFor(JsonNode.class).readValues(parser)) {
            read(lines, reader);
        } catch (EOFException | ZipException | JsonProcessingException e) {
            throw new DamagedException(e.getMessage(), e);
        } catch (RuntimeJsonMappingException | IllegalArgumentException | NgsiError e) {
            throw new DamagedException(e.getMessage(), e);
        }
    }

    private static void read(MappingIterator<JsonNode> lines, Reader reader)
            throws IOException, DamagedException, NgsiError {
        int version =
                lines.hasNextValue() ? lines.nextValue().path(VERSION_FIELD).asInt() : 0;
        if (version != VERSION) {
            throw new DamagedException("it is of version " + version + ", not " + VERSION, null);
        }
        for (int count = 0; lines.hasNextValue(); count++) {
            JsonNode line = lines.nextValue();
            if (line.has(END_FIELD)) {
                // Asked in this order, because the check sum of the whole file comes after its last line.
                if (lines.hasNextValue() || line.get(END_FIELD).asInt() != count) {
                    throw new DamagedException("its end is in the wrong place", null);
                }
                return;
            }
            reader.take(line);
        }
        throw new DamagedException("its end is missing", null);
    }

    void write(Iterable<ObjectNode> lines) throws IOException {
        Files.createDirectories(path.getParent());
        Path temporary = path.resolveSibling(path.getFileName() + ".tmp");
        // Not a channel: an interrupt would close it in the middle.
        try (FileOutputStream file = new FileOutputStream(temporary.toFile());
                Fast gzip = new Fast(file);
                SequenceWriter writer =
                        NgsiJson.mapper().writer().withRootValueSeparator("\n").writeValues((OutputStream) gzip)) {
            writer.write(JsonNodeFactory.instance.objectNode().put(VERSION_FIELD, VERSION));
            int count = 0;
            for (ObjectNode line : lines) {
                writer.write(line);
                count++;
            }
            writer.write(JsonNodeFactory.instance.objectNode().put(END_FIELD, count));
            writer.flush();
            gzip.finish();
            file.getFD().sync();
        }
        Files.move(temporary, path, StandardCopyOption.ATOMIC_MOVE, StandardCopyOption.REPLACE_EXISTING);
    }

    @Override
    public String toString() {
        return path.toString();
    }

    private static final class Fast extends GZIPOutputStream {
        private Fast(OutputStream out) throws IOException {
            super(out, BUFFER);
            def.setLevel(Deflater.BEST_SPEED);
        }
    }
}
