package io.furrow.model.field;

import java.io.IOException;
import java.nio.file.Path;

import io.furrow.model.file.FileProblem;

/** Thrown if a field file cannot be read at all; the message says which file, what is wrong and what to do. */
public final class InvalidFileException extends Exception {
    private static final long serialVersionUID = 1L;

    public InvalidFileException(String message) {
        super(message);
    }

    public InvalidFileException(Path file, IOException cause) {
        super("%s cannot be read: %s; name a readable file".formatted(file, FileProblem.of(cause)), cause);
    }

    public InvalidFileException(String message, Throwable cause) {
        super(message, cause);
    }
}
