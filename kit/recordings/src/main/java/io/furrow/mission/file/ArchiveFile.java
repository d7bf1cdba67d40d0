package io.furrow.mission.file;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.util.Optional;
import java.util.zip.GZIPInputStream;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonToken;

import io.furrow.mission.Cursor;
import io.furrow.mission.RecordingDeletedException;
import io.furrow.model.ngsi.NgsiJson;

/** Reads the lines of one file, which must be in the order of events, and parses their ids and times. */
final class ArchiveFile implements AutoCloseable {
    private static final int BUFFER = 64 * 1024;
    /** Several times the maximum size of a document. */
    private static final int MAX_LINE_LENGTH = 64 * 1024 * 1024;

    private final String name;
    private final InputStream in;
    private final byte[] buffer = new byte[BUFFER];
    private int next;
    private int filled;
    private final ByteArrayOutputStream line = new ByteArrayOutputStream(2048);
    private Cursor last = Cursor.START;
    private long number;

    /**
     * A line.
     *
     * @param at its place in the order; for an invalid line that of the line above
     * @param where for messages
     * @param problem why it is invalid; null if it may be an event
     */
    record Line(Cursor at, byte[] json, String where, String problem) {}

    ArchiveFile(RecordingFiles files, String path) throws IOException {
        this.name = path;
        InputStream file = files.open(path);
        try {
            this.in = path.endsWith(".gz") ? new GZIPInputStream(file, BUFFER) : file;
        } catch (IOException e) {
            file.close();
            throw e;
        }
    }

    /**
     * Returns the next line; null at the end.
     *
     * @throws RecordingException if the line is out of order
     */
    Line next() throws IOException {
        byte[] json = readLine();
        if (json == null) {
            return null;
        }
        String where = "%s, line %d".formatted(name, number);
        Optional<Cursor> position = position(json);
        if (position.isEmpty()) {
            return new Line(last, json, where, "no event: it lacks an id or a time, or is not JSON");
        }
        Cursor at = position.get();
        int order = at.compareTo(last);
        if (order < 0) {
            throw new RecordingDeletedException(
                    "%s is out of order: its event is of %d, that above of %d. Import the file into "
                                    .formatted(where, at.time(), last.time())
                            + "a mission (./furrow mission import) and export that.");
        }
        last = at;
        return new Line(at, json, where, order == 0 ? "a duplicate of the line above" : null);
    }

    private static Optional<Cursor> position(byte[] json) {
        try (JsonParser parser = NgsiJson.mapper().getFactory().createParser(json)) {
            String id = null;
            Long time = null;
            if (parser.nextToken() != JsonToken.START_OBJECT) {
                return Optional.empty();
            }
            while ((id == null || time == null) && parser.nextToken() == JsonToken.FIELD_NAME) {
                String field = parser.currentName();
                JsonToken value = parser.nextToken();
                if (field.equals("id") && value == JsonToken.VALUE_STRING) {
                    id = parser.getText();
                } else if (field.equals("time") && value == JsonToken.VALUE_NUMBER_INT) {
                    time = parser.getLongValue();
                } else {
                    parser.skipChildren();
                }
            }
            return id == null || id.isEmpty() || time == null ? Optional.empty() : Optional.of(new Cursor(time, id));
        } catch (IOException | NumberFormatException e) {
            return Optional.empty(); // the caller reports the reason
        }
    }

    private byte[] readLine() throws IOException {
        if (!fill()) {
            return null;
        }
        number++;
        line.reset();
        boolean ends = false;
        while (!ends && fill()) {
            int end = next;
            while (end < filled && buffer[end] != '\n') {
                end++;
            }
            if (line.size() + end - next > MAX_LINE_LENGTH) {
                throw new RecordingDeletedException("%s, line %d is longer than %d MiB: this is not an exported mission"
                        .formatted(name, number, MAX_LINE_LENGTH >> 20));
            }
            line.write(buffer, next, end - next);
            ends = end < filled;
            next = ends ? end + 1 : end;
        }
        return line.toByteArray();
    }

    /** Fills the buffer if it is empty; returns false at the end. */
    private boolean fill() throws IOException {
        if (next == filled) {
            next = 0;
            filled = Math.max(0, in.read(buffer));
        }
        return next < filled;
    }

    @Override
    public void close() throws IOException {
        in.close();
    }
}
