package io.furrow.fields.file;

/** Thrown if a field file cannot be read at all; the message says which file, what is wrong and what to do. */
public final class UnusableFileException extends Exception {
    private static final long serialVersionUID = 1L;

    public UnusableFileException(String message) {
        super(message);
    }

    UnusableFileException(String message, Throwable cause) {
        super(message, cause);
    }
}
