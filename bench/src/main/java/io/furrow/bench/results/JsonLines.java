package io.furrow.bench.results;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.ObjectMapper;

/** Stores results in a growing file of JSON lines, so that an interrupted measurement can continue. */
public final class JsonLines<T> {
    private static final ObjectMapper JSON = new ObjectMapper();

    private final Path file;
    private final List<T> all = new ArrayList<>();

    private JsonLines(Path file) {
        this.file = file;
    }

    /**
     * Reads the file, if it exists.
     *
     * @param bench that writes such files, for messages
     * @throws IOException if its content is invalid
     */
    public static <T> JsonLines<T> in(Path file, Class<T> type, String bench) throws IOException {
        JsonLines<T> lines = new JsonLines<>(file);
        if (Files.exists(file)) {
            for (String line : Files.readAllLines(file)) {
                try {
                    lines.all.add(JSON.readValue(line, type));
                } catch (IOException e) {
                    throw new IOException(
                            file + " is not a file of './furrow bench " + bench
                                    + "'; name one that is, or a new one (--results)",
                            e);
                }
            }
        }
        return lines;
    }

    public void add(T line) throws IOException {
        Files.writeString(
                file,
                JSON.writeValueAsString(line) + "\n",
                StandardCharsets.UTF_8,
                StandardOpenOption.CREATE,
                StandardOpenOption.APPEND);
        all.add(line);
    }

    /** In the order in which they were added. */
    public List<T> all() {
        return List.copyOf(all);
    }
}
