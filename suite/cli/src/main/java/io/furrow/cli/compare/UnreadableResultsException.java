package io.furrow.cli.compare;

/** There is nothing to compare, or Kafka does not answer; the message says what to do. */
final class UnreadableResultsException extends Exception {
    private static final long serialVersionUID = 1L;

    UnreadableResultsException(String message) {
        super(message);
    }

    UnreadableResultsException(String message, Throwable cause) {
        super(message, cause);
    }
}
