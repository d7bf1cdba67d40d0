package io.furrow.bench.frame;

import java.io.IOException;
import java.nio.file.Path;

import com.fasterxml.jackson.databind.ObjectMapper;
import picocli.CommandLine.Option;

/** The option for a JSON file with a benchmark's figures. */
public final class OutputOption {
    private static final ObjectMapper JSON = new ObjectMapper();

    @Option(names = "--output", paramLabel = "FILE", description = "Also write every figure here, as JSON.")
    private Path file;

    /** Writes a tree, or a record with its components as members, if a file is configured. */
    public void write(Object figures) throws IOException {
        if (file != null) {
            JSON.writeValue(file.toFile(), figures);
        }
    }
}
