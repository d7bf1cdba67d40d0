package io.furrow.bench.sink;

import java.net.URI;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.util.BitSet;

import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.io.Content;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.util.BufferUtil;
import org.eclipse.jetty.util.Callback;
import org.eclipse.jetty.util.Promise;

import io.furrow.bench.http.BaselineServer;
import io.furrow.bench.http.NotificationRequest;

/** A context broker without entities that accepts every update and records the numbers in the bodies with their times. */
final class StubBroker implements AutoCloseable {
    private static final String QUERY = "/v2/op/query";
    private static final byte[] NO_ENTITIES = "[]".getBytes(StandardCharsets.US_ASCII);

    private final BaselineServer server = BaselineServer.start("bare-broker", this::handle);
    private final BitSet numbers = new BitSet();
    private long entities;
    private long requests;
    private long firstNanos;
    private long lastNanos;

    private StubBroker() {}

    /** Starts on a free port. */
    static StubBroker start() {
        return new StubBroker();
    }

    URI uri() {
        return URI.create("http://127.0.0.1:" + server.address().getPort());
    }

    private synchronized void count(String path, byte[] body) {
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

    /** The numbers received. */
    synchronized BitSet numbers() {
        return (BitSet) numbers.clone();
    }

    /** Entities in all bodies: fewer than records if some were merged. */
    synchronized long entities() {
        return entities;
    }

    /** Updates and queries. */
    synchronized long requests() {
        return requests;
    }

    /** From the first request to the last. */
    synchronized long nanos() {
        return lastNanos - firstNanos;
    }

    private void handle(Request request, Response response, Callback callback) {
        String path = request.getHttpURI().getPath();
        Content.Source.asByteBuffer(
                request,
                Promise.from(
                        body -> {
                            count(path, BufferUtil.toArray(body));
                            boolean question = path.equals(QUERY);
                            response.setStatus(question ? 200 : 204);
                            if (question) {
                                response.getHeaders().put(HttpHeader.CONTENT_TYPE, "application/json");
                            }
                            response.write(true, ByteBuffer.wrap(question ? NO_ENTITIES : new byte[0]), callback);
                        },
                        callback::failed));
    }

    @Override
    public void close() {
        server.close();
    }
}
