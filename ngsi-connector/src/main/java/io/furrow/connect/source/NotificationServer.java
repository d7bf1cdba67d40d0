package io.furrow.connect.source;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.net.BindException;
import java.net.InetSocketAddress;
import java.time.Duration;

import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.HttpConfiguration;
import org.eclipse.jetty.server.HttpConnectionFactory;
import org.eclipse.jetty.server.Server;
import org.eclipse.jetty.server.ServerConnector;
import org.eclipse.jetty.server.handler.GracefulHandler;
import org.eclipse.jetty.util.component.LifeCycle;
import org.eclipse.jetty.util.thread.QueuedThreadPool;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** An HTTP/1.1 server on one address; closing it frees the port within a second. */
final class NotificationServer implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(NotificationServer.class);

    private static final int THREADS = 16;
    private static final Duration STOP_WITHIN = Duration.ofMillis(800);
    private static final Duration IDLE_AFTER_STOP = Duration.ofMillis(100);
    private static final Duration BIND_PAUSE = Duration.ofMillis(100);

    private final Server server;
    private final ServerConnector connector;

    private NotificationServer(InetSocketAddress address, Handler handler, Duration idleTimeout) {
        QueuedThreadPool threads = new QueuedThreadPool(THREADS, 4);
        threads.setName("ngsi-source");
        threads.setDaemon(true);
        server = new Server(threads);
        server.setStopTimeout(STOP_WITHIN.toMillis());
        server.setHandler(new GracefulHandler(handler));
        HttpConfiguration http = new HttpConfiguration();
        http.setSendServerVersion(false);
        connector = new ServerConnector(server, 1, 1, new HttpConnectionFactory(http));
        connector.setHost(address.getHostString());
        connector.setPort(address.getPort());
        connector.setIdleTimeout(idleTimeout.toMillis());
        connector.setShutdownIdleTimeout(IDLE_AFTER_STOP.toMillis());
        server.addConnector(connector);
    }

    /**
     * Starts a server.
     *
     * @param address port 0 for a free one
     * @param idleTimeout after which a silent connection is closed
     * @param patience how long to wait for a port that is taken: a predecessor may still be about to free it
     * @throws UncheckedIOException if the address cannot be listened on
     */
    static NotificationServer start(
            InetSocketAddress address, Handler handler, Duration idleTimeout, Duration patience) {
        NotificationServer server = new NotificationServer(address, handler, idleTimeout);
        try {
            server.open(address, System.nanoTime() + patience.toNanos());
            LifeCycle.start(server.server);
            return server;
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    private void open(InetSocketAddress address, long deadline) throws IOException {
        while (true) {
            try {
                connector.open();
                return;
            } catch (IOException e) {
                boolean taken = e instanceof BindException || e.getCause() instanceof BindException;
                if (!taken || System.nanoTime() > deadline || !pause()) {
                    throw new IOException("cannot listen on " + address + ": " + e.getMessage(), e);
                }
            }
        }
    }

    /** Whether the pause was not interrupted; the interrupt stays set. */
    private static boolean pause() {
        try {
            Thread.sleep(BIND_PAUSE.toMillis());
            return true;
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            return false;
        }
    }

    int port() {
        return connector.getLocalPort();
    }

    @Override
    public void close() {
        try {
            LifeCycle.stop(server);
        } catch (RuntimeException e) {
            LOG.debug("connections were cut when the server stopped", e);
        }
    }
}
