package io.furrow.cli.control.client;

/** The control plane is unavailable, or refused; the message says why and what to do. */
public final class ControlPlaneException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final boolean unknown;

    public ControlPlaneException(String message) {
        this(message, false);
    }

    /** @param unknown whether the requested object does not exist */
    ControlPlaneException(String message, boolean unknown) {
        super(message);
        this.unknown = unknown;
    }

    public ControlPlaneException(String message, Throwable cause) {
        super(message, cause);
        this.unknown = false;
    }

    /** Whether the requested object does not exist. */
    public boolean isUnknown() {
        return unknown;
    }
}
