package io.furrow.bench.sink;

import java.net.URI;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.util.BitSet;

import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.io.Content;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.HttpConfiguration;
import org.eclipse.jetty.server.HttpConnectionFactory;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.server.Server;
import org.eclipse.jetty.server.ServerConnector;
import org.eclipse.jetty.util.Callback;
import org.eclipse.jetty.util.Promise;
import org.eclipse.jetty.util.component.LifeCycle;
import org.eclipse.jetty.util.thread.QueuedThreadPool;

import io.furrow.bench.http.NotificationRequest;

/** A context broker that knows no entity and takes every update: it notes the numbers in the bodies, and when they came. */
public final class StubBroker implements AutoCloseable {
    private static final String QUERY = "/v2/op/query";
    private static final byte[] NO_ENTITIES = "[]".getBytes(StandardCharsets.US_ASCII);

    private final Server server;
    private final ServerConnector connector;
    private final BitSet numbers = new BitSet();
    private long entities;
    private long requests;
    private long firstNanos;
    private long lastNanos;

    private StubBroker() {
        QueuedThreadPool threads = new QueuedThreadPool(16, 4);
        threads.setName("bare-broker");
        threads.setDaemon(true);
        server = new Server(threads);
        HttpConfiguration http = new HttpConfiguration();
        http.setSendServerVersion(false);
        connector = new ServerConnector(server, 1, 1, new HttpConnectionFactory(http));
        connector.setHost("127.0.0.1");
        server.addConnector(connector);
        server.setHandler(new Answering());
    }

    /** On a free port. */
    public static StubBroker start() {
        StubBroker broker = new StubBroker();
        LifeCycle.start(broker.server);
        return broker;
    }

    public URI uri() {
        return URI.create("http://127.0.0.1:" + connector.getLocalPort());
    }

    private synchronized void note(String path, byte[] body) {
        requests++;
        lastNanos = System.nanoTime();
        if (firstNanos == 0) {
            firstNanos = lastNanos;
        }
        if (!path.equals(QUERY)) {
            NotificationRequest.numbersIn(body).forEach(number -> {
                numbers.set((int) number);
                entities++;
            });
        }
    }

    /** The numbers that have come. */
    synchronized BitSet numbers() {
        return (BitSet) numbers.clone();
    }

    /** Entities in all bodies: fewer than records where several were merged. */
    synchronized long entities() {
        return entities;
    }

    /** Updates and questions. */
    synchronized long requests() {
        return requests;
    }

    /** From the first request to the last. */
    synchronized long nanos() {
        return lastNanos - firstNanos;
    }

    @Override
    public void close() {
        LifeCycle.stop(server);
    }

    private final class Answering extends Handler.Abstract.NonBlocking {
        @Override
        public boolean handle(Request request, Response response, Callback callback) {
            String path = request.getHttpURI().getPath();
            Content.Source.asByteBuffer(
                    request, Promise.from(body -> answer(path, body, response, callback), callback::failed));
            return true;
        }

        private void answer(String path, ByteBuffer body, Response response, Callback callback) {
            byte[] bytes = new byte[body.remaining()];
            body.get(bytes);
            note(path, bytes);
            boolean question = path.equals(QUERY);
            response.setStatus(question ? 200 : 204);
            if (question) {
                response.getHeaders().put(HttpHeader.CONTENT_TYPE, "application/json");
            }
            response.write(true, ByteBuffer.wrap(question ? NO_ENTITIES : new byte[0]), callback);
        }
    }
}
