package io.furrow.fiware.http;

import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.net.URI;
import java.net.URLDecoder;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.List;

import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.server.Handler;
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
import io.furrow.http.Decision;
import io.furrow.http.OptionNames;
import io.furrow.http.jetty.AccessHandler;

/** Serves an endpoint over HTTP/1.1 on 127.0.0.1; request bodies have at most {@value #MAX_BODY} bytes, as Orion's. */
public final class LoopbackServer implements AutoCloseable {
    public static final int MAX_BODY = 1 << 20;
    private static final long MAX_SKIPPED = 64L << 20;
    private static final String HOST = "127.0.0.1";
    private static final OptionNames OPTIONS = new OptionNames("--allowed-hosts", "--allowed-origins");
    private static final int THREADS = 24;
    private static final long IDLE_TIMEOUT_MS = 60_000;

    /** Answers requests. */
    public interface Endpoint {
        NgsiResponse answer(NgsiRequest call) throws NgsiError;

        /** The answer to a refused request. */
        NgsiResponse describe(NgsiError error);
    }

    private final Server server;
    private final ServerConnector connector;

    /**
     * @param name of the threads
     *
     * @param allowed hosts and origins besides loopback
     */
    public static LoopbackServer start(String name, int port, AllowedNames allowed, Endpoint endpoint) {
        LoopbackServer server = new LoopbackServer(name, port, allowed, endpoint);
        try {
            server.connector.open();
        } catch (IOException e) {
            throw new UncheckedIOException(
                    "the " + name + " cannot listen on " + HOST + ":" + port
                            + "; choose another port or 0 for a free one",
                    e);
        }
        LifeCycle.start(server.server);
        return server;
    }

    private LoopbackServer(String name, int port, AllowedNames allowed, Endpoint endpoint) {
        QueuedThreadPool threads = new QueuedThreadPool(THREADS, 2);
        threads.setName(name);
        threads.setDaemon(true);
        server = new Server(threads);
        connector = new ServerConnector(server, 1, 1, new HttpConnectionFactory(AccessHandler.configuration()));
        connector.setHost(HOST);
        connector.setPort(port);
        connector.setIdleTimeout(IDLE_TIMEOUT_MS);
        connector.setShutdownIdleTimeout(0);
        server.addConnector(connector);
        server.setStopTimeout(0);
        server.setHandler(new AccessHandler(
                AccessRule.allowing(allowed, OPTIONS),
                refused -> (endpoint.describe(new NgsiError(Decision.REFUSED_STATUS, refused.error(), refused.reason()))
                        .body()),
                new Answering(endpoint)));
    }

    public URI uri() {
        return URI.create("http://" + HOST + ":" + connector.getLocalPort());
    }

    @Override
    public void close() {
        LifeCycle.stop(server);
    }

    private static final class Answering extends Handler.Abstract {
        private final Endpoint endpoint;

        private Answering(Endpoint endpoint) {
            this.endpoint = endpoint;
        }

        @Override
        public boolean handle(Request request, Response response, Callback callback) throws IOException {
            Correlator correlator = correlator(request);
            response.getHeaders().put(Correlator.HEADER, correlator.id());
            try {
                write(response, callback, endpoint.answer(call(request, correlator)));
            } catch (NgsiError e) {
                write(response, callback, endpoint.describe(e));
            }
            return true;
        }

        private static Correlator correlator(Request request) {
            String id = request.getHeaders().get(Correlator.HEADER);
            return id == null || id.isBlank() ? Correlator.fresh() : new Correlator(id);
        }

        private static NgsiRequest call(Request request, Correlator correlator) throws IOException, NgsiError {
            return new NgsiRequest(
                    request.getMethod(),
                    segments(request.getHttpURI().getPath()),
                    Request.extractQueryParameters(request, StandardCharsets.UTF_8),
                    request.getHeaders(),
                    correlator,
                    body(request));
        }

        private static List<String> segments(String path) {
            List<String> segments = new ArrayList<>();
            for (String segment : path.split("/")) {
                if (!segment.isEmpty()) {
                    // A plus sign is literal in a path, but the decoder takes it for a space.
                    segments.add(URLDecoder.decode(segment.replace("+", "%2B"), StandardCharsets.UTF_8));
                }
            }
            return segments;
        }

        /** Reads an oversized body to its end, or the client would see a broken connection instead of the answer. */
        private static byte[] body(Request request) throws IOException, NgsiError {
            try (InputStream in = Request.asInputStream(request)) {
                byte[] body = in.readNBytes(MAX_BODY + 1);
                if (body.length <= MAX_BODY) {
                    return body;
                }
                long rest = 0;
                for (long skipped = -1; skipped != 0 && rest < MAX_SKIPPED; rest += skipped) {
                    skipped = in.skip(MAX_BODY);
                }
                throw NgsiError.tooLarge(body.length + rest, MAX_BODY);
            }
        }

        private static void write(Response response, Callback callback, NgsiResponse reply) {
            response.setStatus(reply.status());
            reply.headers().forEach(response.getHeaders()::put);
            if (reply.body().length > 0) {
                response.getHeaders().put(HttpHeader.CONTENT_TYPE, reply.mediaType());
            }
            response.write(true, ByteBuffer.wrap(reply.body()), callback);
        }
    }
}
