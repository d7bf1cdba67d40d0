package io.furrow.control.device;

import java.io.IOException;

/** Sends a command to a device of the farm. */
@FunctionalInterface
public interface CommandSender {

    /**
     * Returns once the context broker has taken the command, which does not say that the device obeyed.
     *
     * @param deviceId entity id of the device
     * @param type entity type of the device; decides how the command is written, {@code Robot} has its own way
     * @param command name of the command
     * @param value what the command needs, empty for nothing
     * @throws IOException when the context broker is away or refuses the command; the message is a sentence that says which
     * @throws InterruptedException when the thread is interrupted while it waits for the context broker
     */
    void send(String deviceId, String type, String command, String value) throws IOException, InterruptedException;
}
