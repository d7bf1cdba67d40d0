package io.furrow.model.field;

import java.io.IOException;
import java.nio.file.Path;

import io.furrow.model.file.FileProblem;

/** Thrown if a field file cannot be read at all; the message says which file, what is wrong and what to do. */
public final class UnusableFileException extends Exception {
    private static final long serialVersionUID = 1L;

    public UnusableFileException(String message) {
        super(message);
    }

    public UnusableFileException(Path file, IOException cause) {
        super("%s cannot be read: %s; name a readable file".formatted(file, FileProblem.of(cause)), cause);
    }

    public UnusableFileException(String message, Throwable cause) {
        super(message, cause);
    }
}
