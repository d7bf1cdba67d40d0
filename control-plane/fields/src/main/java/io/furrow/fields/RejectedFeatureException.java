package io.furrow.fields;

/** Thrown if a single feature cannot be imported; the message is the reason. */
final class RejectedFeatureException extends Exception {
    private static final long serialVersionUID = 1L;

    RejectedFeatureException(String reason) {
        super(reason);
    }
}
