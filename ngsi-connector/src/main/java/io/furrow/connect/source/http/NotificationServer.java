package io.furrow.connect.source.http;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.net.BindException;
import java.net.InetSocketAddress;
import java.time.Duration;
import java.util.Optional;
import java.util.concurrent.TimeUnit;

import org.eclipse.jetty.http.HttpStatus;
import org.eclipse.jetty.http.HttpVersion;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.HttpConfiguration;
import org.eclipse.jetty.server.HttpConnectionFactory;
import org.eclipse.jetty.server.NetworkConnectionLimit;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.server.Server;
import org.eclipse.jetty.server.ServerConnector;
import org.eclipse.jetty.server.SslConnectionFactory;
import org.eclipse.jetty.server.handler.ErrorHandler;
import org.eclipse.jetty.server.handler.GracefulHandler;
import org.eclipse.jetty.util.Callback;
import org.eclipse.jetty.util.component.LifeCycle;
import org.eclipse.jetty.util.ssl.SslContextFactory;
import org.eclipse.jetty.util.thread.QueuedThreadPool;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.ledger.Ledger;
import io.furrow.model.text.FailureText;

/** An HTTP/1.1 server on one address; closing it frees the port within a second. */
public final class NotificationServer implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(NotificationServer.class);

    private static final int THREADS = 16;
    /**
     * Connections that a burst may open before the acceptor accepts them; beyond it, a sender retries after a second.
     */
    private static final int ACCEPT_QUEUE = 1024;

    private static final Duration STOP_WITHIN = Duration.ofMillis(800);
    private static final Duration IDLE_AFTER_STOP = Duration.ofMillis(100);
    private static final Duration BIND_PAUSE = Duration.ofMillis(100);
    private static final long SWEEP_MS = 1000;

    /**
     * @param address port 0 for a free one
     * @param tls empty for plain text
     * @param maxConnections maximum concurrent connections
     * @param idle after which an idle connection is closed
     * @param request the longest time from the first byte of a request to its answer
     * @param resets whether the connection of a request that comes while the server stops is reset rather than
     *     answered 503
     */
    public record Settings(
            InetSocketAddress address,
            Optional<SslContextFactory.Server> tls,
            int maxConnections,
            Duration idle,
            Duration request,
            boolean resets) {}

    /** The graceful handler answers 503 while the server stops, which Orion would take for success. */
    private static final class ResettingErrorHandler extends ErrorHandler {
        @Override
        public boolean handle(Request request, Response response, Callback callback) throws Exception {
            if (response.getStatus() == HttpStatus.SERVICE_UNAVAILABLE_503) {
                NotificationHandler.reset(request, callback);
                return true;
            }
            return super.handle(request, response, callback);
        }
    }

    private final Server server;
    private final ServerConnector connector;
    private final RequestTimeouts slowSenders;
    private final long sweepMillis;

    private NotificationServer(Settings settings, QueuedThreadPool threads, Handler handler, Ledger ledger) {
        slowSenders = new RequestTimeouts(settings.request().toNanos(), ledger);
        sweepMillis = Math.min(SWEEP_MS, settings.request().toMillis());
        server = new Server(threads);
        server.setStopTimeout(STOP_WITHIN.toMillis());
        server.setHandler(new GracefulHandler(slowSenders.watching(handler)));
        if (settings.resets()) {
            server.setErrorHandler(new ResettingErrorHandler());
        }
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

    /** The threads of a server; its handler may use them too. */
    public static QueuedThreadPool threads() {
        QueuedThreadPool threads = new QueuedThreadPool(THREADS, 4);
        threads.setName("ngsi-source");
        threads.setDaemon(true);
        return threads;
    }

    /**
     * Starts a server.
     *
     * @param threads of {@link #threads}, for this server only
     * @param timeout how long to wait for a port that is in use: a predecessor may be about to free it
     * @throws UncheckedIOException if the server cannot listen on the address
     */
    public static NotificationServer start(
            Settings settings, QueuedThreadPool threads, Handler handler, Ledger ledger, Duration timeout) {
        NotificationServer server = new NotificationServer(settings, threads, handler, ledger);
        try {
            server.open(settings.address(), System.nanoTime() + timeout.toNanos());
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
                    throw new IOException("cannot listen on " + address + ": " + FailureText.of(e), e);
                }
            }
        }
    }

    /** Sleeps; returns false if it was interrupted. The interrupt status stays set. */
    private static boolean pause() {
        try {
            Thread.sleep(BIND_PAUSE.toMillis());
            return true;
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            return false;
        }
    }

    public int port() {
        return connector.getLocalPort();
    }

    @Override
    public void close() {
        try {
            LifeCycle.stop(server);
        } catch (RuntimeException e) {
            LOG.debug("connections were closed when the server stopped", e);
        }
    }
}
