package io.furrow.provisioner;

/** Thrown if the IoT Agent rejects a device or service group; the message is a sentence for the device's status. */
final class RejectedByAgentException extends Exception {
    private static final long serialVersionUID = 1;

    RejectedByAgentException(String message) {
        super(message);
    }
}
