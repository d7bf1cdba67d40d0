package io.furrow.embedded;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.net.InetAddress;
import java.net.ServerSocket;

/** Ports on loopback that nobody listens on at the moment of asking. */
public final class FreePort {
    private FreePort() {}

    /** A free port that differs from one that is spoken for but not listened on yet. */
    static int otherThan(int taken) {
        int port = orFree(0);
        while (port == taken) {
            port = orFree(0);
        }
        return port;
    }

    /** The port itself, or a free one where it is 0. */
    public static int orFree(int port) {
        if (port != 0) {
            return port;
        }
        try (ServerSocket socket = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            return socket.getLocalPort();
        } catch (IOException e) {
            throw new UncheckedIOException("no free port on loopback", e);
        }
    }
}
