package io.furrow.control.field;

/** A feature that cannot become a field, while the others of its file can; the message is the reason. */
final class RefusedFeatureException extends Exception {
    private static final long serialVersionUID = 1L;

    RefusedFeatureException(String reason) {
        super(reason);
    }
}
