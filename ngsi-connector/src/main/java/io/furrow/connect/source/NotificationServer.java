package io.furrow.connect.source;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.net.BindException;
import java.net.InetSocketAddress;
import java.time.Duration;
import java.util.Optional;
import java.util.concurrent.TimeUnit;

import org.eclipse.jetty.http.HttpVersion;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.HttpConfiguration;
import org.eclipse.jetty.server.HttpConnectionFactory;
import org.eclipse.jetty.server.NetworkConnectionLimit;
import org.eclipse.jetty.server.Server;
import org.eclipse.jetty.server.ServerConnector;
import org.eclipse.jetty.server.SslConnectionFactory;
import org.eclipse.jetty.server.handler.GracefulHandler;
import org.eclipse.jetty.util.component.LifeCycle;
import org.eclipse.jetty.util.ssl.SslContextFactory;
import org.eclipse.jetty.util.thread.QueuedThreadPool;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.ledger.Ledger;

/** An HTTP/1.1 server on one address; closing it frees the port within a second. */
final class NotificationServer implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(NotificationServer.class);

    private static final int THREADS = 16;
    /** Connections that a burst may make before the acceptor comes to them; beyond it, a sender tries again after a second. */
    private static final int ACCEPT_QUEUE = 1024;

    private static final Duration STOP_WITHIN = Duration.ofMillis(800);
    private static final Duration IDLE_AFTER_STOP = Duration.ofMillis(100);
    private static final Duration BIND_PAUSE = Duration.ofMillis(100);
    private static final long SWEEP_MS = 1000;

    /**
     * @param address port 0 for a free one
     * @param tls empty for plain text
     * @param maxConnections at a time
     * @param idle after which a silent connection is closed
     * @param request the longest time from the first byte of a request to its answer
     */
    record Settings(
            InetSocketAddress address,
            Optional<SslContextFactory.Server> tls,
            int maxConnections,
            Duration idle,
            Duration request) {}

    private final Server server;
    private final ServerConnector connector;
    private final SlowSenders slowSenders;
    private final long sweepMillis;

    private NotificationServer(Settings settings, QueuedThreadPool threads, Handler handler, Ledger ledger) {
        slowSenders = new SlowSenders(settings.request().toNanos(), ledger);
        sweepMillis = Math.min(SWEEP_MS, settings.request().toMillis());
        server = new Server(threads);
        server.setStopTimeout(STOP_WITHIN.toMillis());
        server.setHandler(new GracefulHandler(slowSenders.watching(handler)));
        HttpConfiguration http = new HttpConfiguration();
        http.setSendServerVersion(false);
        http.setSendDateHeader(false);
        HttpConnectionFactory plain = new HttpConnectionFactory(http);
        connector = settings.tls()
                .map(tls -> new ServerConnector(
                        server, 1, 1, new SslConnectionFactory(tls, HttpVersion.HTTP_1_1.asString()), plain))
                .orElseGet(() -> new ServerConnector(server, 1, 1, plain));
        connector.setHost(settings.address().getHostString());
        connector.setPort(settings.address().getPort());
        connector.setAcceptQueueSize(ACCEPT_QUEUE);
        connector.setIdleTimeout(settings.idle().toMillis());
        connector.setShutdownIdleTimeout(IDLE_AFTER_STOP.toMillis());
        connector.addBean(slowSenders);
        connector.addBean(new NetworkConnectionLimit(settings.maxConnections(), connector));
        server.addConnector(connector);
    }

    /** The threads of a server, which its handler may use too. */
    static QueuedThreadPool threads() {
        QueuedThreadPool threads = new QueuedThreadPool(THREADS, 4);
        threads.setName("ngsi-source");
        threads.setDaemon(true);
        return threads;
    }

    /**
     * Starts a server.
     *
     * @param threads of {@link #threads}, for this server alone
     * @param patience how long to wait for a port that is taken: a predecessor may still be about to free it
     * @throws UncheckedIOException if the address cannot be listened on
     */
    static NotificationServer start(
            Settings settings, QueuedThreadPool threads, Handler handler, Ledger ledger, Duration patience) {
        NotificationServer server = new NotificationServer(settings, threads, handler, ledger);
        try {
            server.open(settings.address(), System.nanoTime() + patience.toNanos());
            LifeCycle.start(server.server);
            server.sweepLater();
            return server;
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    private void sweepLater() {
        connector.getScheduler().schedule(this::sweep, sweepMillis, TimeUnit.MILLISECONDS);
    }

    private void sweep() {
        try {
            slowSenders.cut();
        } finally {
            if (server.isRunning()) {
                sweepLater();
            }
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
