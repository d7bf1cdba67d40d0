package io.furrow.soak.control;

import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.net.URI;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;

import io.furrow.embedded.FreePort;

/** A TCP proxy on loopback before a server, which passes, refuses connections, or accepts them and says nothing. */
final class FaultProxy implements AutoCloseable {
    private static final int BUFFER_BYTES = 8192;

    /** What it does with connections. */
    enum Mode {
        PASS,
        /** There is no listener. */
        REFUSE,
        /** Connections are accepted, and nothing passes on them. */
        HANG
    }

    private final int port = FreePort.orFree(0);
    private final int target;
    private final Set<Socket> open = ConcurrentHashMap.newKeySet();
    private volatile Mode mode = Mode.REFUSE;
    private volatile ServerSocket server;

    /** It passes at once. @param target on loopback */
    FaultProxy(URI target) throws IOException {
        this.target = target.getPort();
        become(Mode.PASS);
    }

    URI uri() {
        return URI.create("http://127.0.0.1:" + port);
    }

    /** Connections that are open go on only where nothing changes. */
    synchronized void become(Mode next) throws IOException {
        boolean listened = mode != Mode.REFUSE;
        mode = next;
        if (next != Mode.HANG) {
            open.forEach(FaultProxy::close);
            open.clear();
        }
        if (next == Mode.REFUSE && listened) {
            server.close();
        } else if (next != Mode.REFUSE && !listened) {
            ServerSocket fresh = new ServerSocket();
            fresh.setReuseAddress(true);
            fresh.bind(new InetSocketAddress(InetAddress.getLoopbackAddress(), port));
            server = fresh;
            daemon(() -> accept(fresh));
        }
    }

    private void accept(ServerSocket listener) {
        while (!listener.isClosed()) {
            try {
                Socket client = listener.accept();
                open.add(client);
                if (mode == Mode.PASS) {
                    connect(client);
                }
            } catch (IOException e) {
                // The listener was closed, or the server behind is away: its client sees a closed connection.
            }
        }
    }

    private void connect(Socket client) throws IOException {
        try {
            Socket behind = new Socket(InetAddress.getLoopbackAddress(), target);
            open.add(behind);
            daemon(() -> copy(client, behind));
            daemon(() -> copy(behind, client));
        } catch (IOException e) {
            open.remove(client);
            client.close();
            throw e;
        }
    }

    private void copy(Socket from, Socket to) {
        byte[] buffer = new byte[BUFFER_BYTES];
        try {
            InputStream in = from.getInputStream();
            OutputStream out = to.getOutputStream();
            for (int count = in.read(buffer); count >= 0; count = in.read(buffer)) {
                if (mode == Mode.HANG) {
                    return; // what comes is swallowed, the connection stays
                }
                out.write(buffer, 0, count);
            }
        } catch (IOException e) {
            // Both ends are closed below.
        }
        for (Socket each : new Socket[] {from, to}) {
            open.remove(each);
            close(each);
        }
    }

    private static void close(Socket socket) {
        try {
            socket.close();
        } catch (IOException e) {
            // It is closed then.
        }
    }

    private static void daemon(Runnable work) {
        Thread thread = new Thread(work, "fault-proxy");
        thread.setDaemon(true);
        thread.start();
    }

    @Override
    public void close() throws IOException {
        become(Mode.REFUSE);
    }
}
