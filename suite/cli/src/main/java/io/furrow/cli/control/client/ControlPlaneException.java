package io.furrow.cli.control.client;

import com.fasterxml.jackson.databind.JsonNode;

/** The control plane is unavailable, or refused; the message says why and what to do. */
public final class ControlPlaneException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final boolean unknown;
    private final transient JsonNode problem;

    public ControlPlaneException(String message) {
        this(message, false, null);
    }

    /**
     * @param unknown whether the requested object does not exist
     * @param problem the answer; null if there is none
     */
    ControlPlaneException(String message, boolean unknown, JsonNode problem) {
        super(message);
        this.unknown = unknown;
        this.problem = problem;
    }

    public ControlPlaneException(String message, Throwable cause) {
        super(message, cause);
        this.unknown = false;
        this.problem = null;
    }

    /** Returns the refusal as the control plane answered it; null if there is none. */
    JsonNode problem() {
        return problem;
    }

    /** Whether the requested object does not exist. */
    public boolean isUnknown() {
        return unknown;
    }
}
