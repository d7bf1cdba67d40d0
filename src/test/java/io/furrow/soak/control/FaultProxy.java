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

/**
 * A TCP proxy on loopback in front of a server, which forwards connections, refuses them, or accepts them without
 * responding.
 */
final class FaultProxy implements AutoCloseable {
    private static final int BUFFER_BYTES = 8192;

    /** The treatment of connections. */
    enum Mode {
        PASS,
        /** Nothing listens. */
        REFUSE,
        /** Connections are accepted, and no bytes are forwarded. */
        HANG
    }

    private final int port = FreePort.orFree(0);
    private final int target;
    private final Set<Socket> open = ConcurrentHashMap.newKeySet();
    private volatile Mode mode = Mode.REFUSE;
    private volatile ServerSocket server;

    /** Forwards connections at first. @param target on loopback */
    FaultProxy(URI target) throws IOException {
        this.target = target.getPort();
        setMode(Mode.PASS);
    }

    URI uri() {
        return URI.create("http://127.0.0.1:" + port);
    }

    /** Sets the mode; except for {@link Mode#HANG}, open connections are closed. */
    synchronized void setMode(Mode next) throws IOException {
        boolean listened = mode != Mode.REFUSE;
        mode = next;
        if (next != Mode.HANG) {
            open.forEach(FaultProxy::close);
            open.clear();
        }
        if (next == Mode.REFUSE && listened) {
            server.close();
        } else if (next != Mode.REFUSE && !listened) {
            ServerSocket listener = new ServerSocket();
            listener.setReuseAddress(true);
            listener.bind(new InetSocketAddress(InetAddress.getLoopbackAddress(), port));
            server = listener;
            daemon(() -> accept(listener));
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
                // The listener was closed, or the target is unavailable: the client sees a closed connection.
            }
        }
    }

    private void connect(Socket client) throws IOException {
        try {
            Socket upstream = new Socket(InetAddress.getLoopbackAddress(), target);
            open.add(upstream);
            daemon(() -> copy(client, upstream));
            daemon(() -> copy(upstream, client));
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
                    return; // drops further bytes, the connection stays open
                }
                out.write(buffer, 0, count);
            }
        } catch (IOException e) {
            // both ends are closed below
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
            // it is closed already
        }
    }

    private static void daemon(Runnable work) {
        Thread thread = new Thread(work, "fault-proxy");
        thread.setDaemon(true);
        thread.start();
    }

    @Override
    public void close() throws IOException {
        setMode(Mode.REFUSE);
    }
}
