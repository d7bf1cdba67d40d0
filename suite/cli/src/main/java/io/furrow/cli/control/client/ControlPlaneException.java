package io.furrow.cli.control.client;

/** The control plane is unavailable, or refused; the message says why and what to do. */
public final class ControlPlaneException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final boolean unknown;

    public ControlPlaneException(String message) {
        this(message, false);
    }

    /** @param unknown whether there is no such thing */
    ControlPlaneException(String message, boolean unknown) {
        super(message);
        this.unknown = unknown;
    }

    public ControlPlaneException(String message, Throwable cause) {
        super(message, cause);
        this.unknown = false;
    }

    /** Whether what was asked for is not there. */
    public boolean isUnknown() {
        return unknown;
    }
}
