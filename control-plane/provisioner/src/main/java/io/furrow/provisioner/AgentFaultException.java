package io.furrow.provisioner;

import java.io.IOException;

/** The IoT Agent is there, but answered a request with 5xx; it may well answer another. */
final class AgentFaultException extends IOException {
    private static final long serialVersionUID = 1;

    AgentFaultException(String message) {
        super(message);
    }
}
