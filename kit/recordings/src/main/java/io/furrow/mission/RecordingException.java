package io.furrow.mission;

import java.io.IOException;

/** Thrown if a recording cannot be read. The message says what happened, where, and what to do. */
public class RecordingException extends IOException {
    private static final long serialVersionUID = 1L;

    public RecordingException(String message, Throwable cause) {
        super(message, cause);
    }

    public RecordingException(String message) {
        super(message);
    }
}
