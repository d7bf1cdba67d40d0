package io.furrow.analytics.field;

/** Reports an invalid file of fields; the message names the file, the feature and the remedy. */
final class InvalidFieldsException extends Exception {
    private static final long serialVersionUID = 1L;

    InvalidFieldsException(String message, Throwable cause) {
        super(message, cause);
    }
}
