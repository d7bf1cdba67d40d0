package io.furrow.model.file;

import java.io.IOException;
import java.nio.file.AccessDeniedException;
import java.nio.file.FileSystemException;
import java.nio.file.NoSuchFileException;

/** Describes why a file could not be read or written, for people. */
public final class FileProblem {
    private FileProblem() {}

    /** Returns a text that follows the file's name in a message, for instance {@code there is no such file or folder}. */
    public static String of(IOException cause) {
        if (cause instanceof NoSuchFileException) {
            return "there is no such file or folder";
        } else if (cause instanceof AccessDeniedException) {
            return "its permissions do not allow it";
        }
        String reason = cause instanceof FileSystemException file && file.getReason() != null
                ? file.getReason()
                : cause.getMessage();
        return reason == null ? "it failed" : reason;
    }
}
