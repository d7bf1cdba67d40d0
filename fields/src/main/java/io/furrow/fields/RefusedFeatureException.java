package io.furrow.fields;

/** Thrown if a single feature cannot be imported; the message is the reason. */
public final class RefusedFeatureException extends Exception {
    private static final long serialVersionUID = 1L;

    public RefusedFeatureException(String reason) {
        super(reason);
    }
}
