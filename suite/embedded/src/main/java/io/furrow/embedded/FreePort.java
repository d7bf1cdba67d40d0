package io.furrow.embedded;

import java.io.IOException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.util.concurrent.atomic.AtomicInteger;

/**
 * Finds ports on loopback that are free at the moment of the call. They are below the range of outgoing connections (from 32768 on
 * Linux), which could otherwise take a port before its server listens.
 */
public final class FreePort {
    private static final int FIRST = 20_000;
    private static final int COUNT = 7_000;
    /** Processes started together have neighboring ids: each begins at least as many ports from the others. */
    private static final int DISTANCE = 97;

    private static final AtomicInteger NEXT =
            new AtomicInteger((int) (ProcessHandle.current().pid() * DISTANCE % COUNT));

    private FreePort() {}

    /** A free port other than one that is assigned but not in use yet. */
    static int otherThan(int assigned) {
        int port = orFree(0);
        return port == assigned ? orFree(0) : port;
    }

    /** The port itself, or a free one if it is 0; a process gets the same port again only after {@value #COUNT} calls. */
    public static int orFree(int port) {
        if (port != 0) {
            return port;
        }
        for (int tried = 0; tried < COUNT; tried++) {
            int candidate = FIRST + Math.floorMod(NEXT.getAndIncrement(), COUNT);
            try (ServerSocket socket = new ServerSocket(candidate, 1, InetAddress.getLoopbackAddress())) {
                return socket.getLocalPort();
            } catch (IOException e) {
                // in use
            }
        }
        throw new IllegalStateException("no free port on loopback from %d to %d".formatted(FIRST, FIRST + COUNT - 1));
    }
}
