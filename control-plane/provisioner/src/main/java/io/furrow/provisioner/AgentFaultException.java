package io.furrow.provisioner;

import java.io.IOException;

/** Thrown if the IoT Agent responds with 5xx; other requests may succeed. */
final class AgentFaultException extends IOException {
    private static final long serialVersionUID = 1;

    AgentFaultException(String message) {
        super(message);
    }
}
