package io.furrow.control.device;

import java.io.IOException;

import io.furrow.model.event.FiwareScope;

/** Sends a command to a device of the farm. */
@FunctionalInterface
public interface CommandSender {

    /**
     * Sends the command and returns once the context broker has accepted it. This does not mean that the device has
     * executed it.
     *
     * @param deviceId entity id of the device
     * @param type entity type of the device; determines how the command is written, {@code Robot} has its own format
     * @param command name of the command
     * @param value argument of the command, empty for none
     * @throws IOException if the context broker is unavailable or rejects the command; the message is a sentence that
     * says which
     * @throws InterruptedException if the thread is interrupted while it waits for the context broker
     */
    void send(String deviceId, String type, String command, String value) throws IOException, InterruptedException;

    /** Sends to devices of another tenant and service path. */
    default CommandSender in(FiwareScope scope) {
        return this;
    }
}
