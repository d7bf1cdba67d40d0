package io.furrow.control.readiness;

import java.io.IOException;
import java.net.URI;
import java.nio.ByteBuffer;
import java.util.function.Supplier;

import com.fasterxml.jackson.databind.node.ObjectNode;
import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.http.HttpMethod;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.HttpConfiguration;
import org.eclipse.jetty.server.HttpConnectionFactory;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.server.Server;
import org.eclipse.jetty.server.ServerConnector;
import org.eclipse.jetty.util.Callback;
import org.eclipse.jetty.util.component.LifeCycle;
import org.eclipse.jetty.util.thread.QueuedThreadPool;

import io.furrow.http.AccessRule;
import io.furrow.http.AllowedNames;
import io.furrow.http.OptionNames;
import io.furrow.http.jetty.AccessHandler;
import io.furrow.kafka.Readiness;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.FailureText;

/**
 * Serves {@code GET /health}, {@code /ready} and {@code /metrics} on a separate port and threads, so that other
 * requests do not delay probes: 200, or 503 if not alive or not ready. Probes may use any host name; requests for
 * metrics must use a name of this server.
 */
public final class HealthServer implements AutoCloseable {
    private static final int THREADS = 6;
    private static final long IDLE_TIMEOUT_MS = 10_000;

    private final Server server;
    private final ServerConnector connector;

    /** The content of the pages. @param metrics in the text format of Prometheus */
    public record Pages(Readiness readiness, Supplier<byte[]> metrics) {}

    private HealthServer(String host, int port, AllowedNames allowed, Pages pages) {
        QueuedThreadPool threads = new QueuedThreadPool(THREADS, 1);
        threads.setName("health");
        threads.setDaemon(true);
        server = new Server(threads);
        HttpConfiguration http = new HttpConfiguration();
        http.setSendServerVersion(false);
        connector = new ServerConnector(server, 1, 1, new HttpConnectionFactory(http));
        connector.setHost(host);
        connector.setPort(port);
        connector.setIdleTimeout(IDLE_TIMEOUT_MS);
        server.addConnector(connector);
        AccessRule rule =
                AccessRule.allowing(allowed, OptionNames.FLAGS).servedAs(host).withProbes("/health", "/ready");
        server.setHandler(new AccessHandler(
                rule, rejection -> NgsiJson.write(error(rejection.error(), rejection.reason())), new Answering(pages)));
    }

    /**
     * Starts listening.
     *
     * @param host address to listen on
     * @param port 0 for a free one
     * @param allowed hosts and origins besides its own
     * @throws IOException if the port is in use
     */
    public static HealthServer start(String host, int port, AllowedNames allowed, Pages pages) throws IOException {
        HealthServer health = new HealthServer(host, port, allowed, pages);
        try {
            health.connector.open();
        } catch (IOException e) {
            throw new IOException(
                    "The health page cannot listen on %s:%d (%s). Choose another port."
                            .formatted(host, port, FailureText.of(e)),
                    e);
        }
        LifeCycle.start(health.server);
        return health;
    }

    public URI uri() {
        return URI.create("http://" + connector.getHost() + ":" + connector.getLocalPort());
    }

    @Override
    public void close() {
        LifeCycle.stop(server);
    }

    private static ObjectNode error(String error, String reason) {
        return NgsiJson.object().put("error", error).put("reason", reason);
    }

    private static final class Answering extends Handler.Abstract.NonBlocking {
        private final Pages pages;

        Answering(Pages pages) {
            this.pages = pages;
        }

        @Override
        public boolean handle(Request request, Response response, Callback callback) {
            boolean reads = HttpMethod.GET.is(request.getMethod()) || HttpMethod.HEAD.is(request.getMethod());
            Readiness readiness = pages.readiness();
            switch (reads ? Request.getPathInContext(request) : "") {
                case "/health" -> json(response, callback, readiness.isAlive() ? 200 : 503, readiness.health());
                case "/ready" -> json(response, callback, readiness.isReady() ? 200 : 503, readiness.readiness());
                case "/metrics" -> {
                    response.getHeaders().put(HttpHeader.CONTENT_TYPE, "text/plain; version=0.0.4; charset=utf-8");
                    response.write(true, ByteBuffer.wrap(pages.metrics().get()), callback);
                }
                default ->
                    json(response, callback, 404, error("not-found", "there are /health, /ready and /metrics here"));
            }
            return true;
        }

        private static void json(Response response, Callback callback, int status, ObjectNode body) {
            response.setStatus(status);
            response.getHeaders().put(HttpHeader.CONTENT_TYPE, "application/json");
            response.getHeaders().put(HttpHeader.CACHE_CONTROL, "no-store");
            response.write(true, ByteBuffer.wrap(NgsiJson.write(body)), callback);
        }
    }
}
