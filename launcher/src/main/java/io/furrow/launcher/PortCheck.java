package io.furrow.launcher;

import java.io.IOException;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.ServerSocket;

/** Finds a port in use before anything is started on it. */
final class PortCheck {
    private PortCheck() {}

    /**
     * @param option the option that sets the port
     * @throws SuiteNotStartedException if somebody listens there
     */
    static void free(int port, String what, String option) {
        if (port == 0) {
            return;
        }
        try (ServerSocket socket = new ServerSocket()) {
            socket.setReuseAddress(true); // a port that is only cooling down is free
            socket.bind(new InetSocketAddress(InetAddress.getLoopbackAddress(), port));
        } catch (IOException e) {
            throw new SuiteNotStartedException(
                    "Port %d of 127.0.0.1, meant for %s, is in use. Stop what listens there, or choose another with %s."
                            .formatted(port, what, option),
                    e);
        }
    }
}
