package io.furrow.analytics.field;

/** A file of fields that a job cannot start with; the message names the file, the feature and the remedy. */
final class InvalidFieldsException extends Exception {
    private static final long serialVersionUID = 1L;

    InvalidFieldsException(String message, Throwable cause) {
        super(message, cause);
    }
}
