package io.furrow.provisioner;

/** A device or service group that the IoT Agent will not take as it is; the message is a sentence for the device's status. */
final class RejectedByAgentException extends Exception {
    private static final long serialVersionUID = 1;

    RejectedByAgentException(String message) {
        super(message);
    }
}
