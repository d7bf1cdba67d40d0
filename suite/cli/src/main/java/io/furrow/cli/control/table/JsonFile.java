package io.furrow.cli.control.table;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.FileSystemException;
import java.nio.file.Files;
import java.nio.file.Path;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.file.FileProblem;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/** Reads JSON from a user's file. */
public final class JsonFile {
    private JsonFile() {}

    /** Parses an argument that begins with a bracket as JSON, reads any other as a file. */
    public static JsonNode readOrParse(String fileOrJson) throws IOException {
        if (!fileOrJson.stripLeading().startsWith("[")) {
            return read(Path.of(fileOrJson));
        }
        try {
            return NgsiJson.read(fileOrJson.getBytes(StandardCharsets.UTF_8));
        } catch (UnreadableException e) {
            throw new IOException("the list of devices is not JSON: " + e.getMessage(), e);
        }
    }

    /** @throws IOException if it holds no JSON; the message names the file */
    public static JsonNode read(Path file) throws IOException {
        try {
            return NgsiJson.readFile(Files.readAllBytes(file));
        } catch (UnreadableException e) {
            throw new IOException(file + " is not JSON: " + e.getMessage(), e);
        } catch (FileSystemException e) {
            throw new IOException(file + ": " + FileProblem.of(e), e);
        }
    }
}
