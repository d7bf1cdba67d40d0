package io.furrow.dashboard.status;

import java.nio.ByteBuffer;

import com.fasterxml.jackson.databind.node.ObjectNode;
import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.http.HttpMethod;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.util.Callback;

import io.furrow.dashboard.http.Problem;
import io.furrow.dashboard.proxy.TopicStreams;
import io.furrow.model.ngsi.NgsiJson;

/**
 * {@code GET /health}, {@code /ready} and {@code /metrics} of the dashboard itself, without a token. It is alive while it answers, and
 * ready where Kafka and the control plane answer too: 200, else 503.
 */
public final class StatusPages extends Handler.Abstract {
    public static final String HEALTH = "/health";
    public static final String READY = "/ready";
    public static final String METRICS = "/metrics";

    private final BackendHealth surroundings;
    private final StreamMetrics metrics;

    public StatusPages(BackendHealth surroundings, TopicStreams streams) {
        this.surroundings = surroundings;
        this.metrics = new StreamMetrics(streams);
    }

    @Override
    public boolean handle(Request request, Response response, Callback callback) {
        if (!HttpMethod.GET.is(request.getMethod()) && !HttpMethod.HEAD.is(request.getMethod())) {
            response.setStatus(405);
            json(response, callback, Problem.json("method-not-allowed", "this page is read with GET"));
            return true;
        }
        switch (Request.getPathInContext(request)) {
            case READY -> ready(response, callback);
            case METRICS -> {
                response.getHeaders().put(HttpHeader.CONTENT_TYPE, StreamMetrics.CONTENT_TYPE);
                response.write(true, ByteBuffer.wrap(metrics.page()), callback);
            }
            default -> json(response, callback, NgsiJson.write(surroundings.page("up")));
        }
        return true;
    }

    private void ready(Response response, Callback callback) {
        boolean ready = surroundings.areUp();
        ObjectNode page = surroundings.page(ready ? "ready" : "not-ready");
        if (!ready) {
            response.setStatus(503);
            response.getHeaders().put(HttpHeader.RETRY_AFTER, "1");
        }
        json(response, callback, NgsiJson.write(page));
    }

    private static void json(Response response, Callback callback, byte[] body) {
        response.getHeaders().put(HttpHeader.CONTENT_TYPE, "application/json");
        response.getHeaders().put(HttpHeader.CACHE_CONTROL, "no-store");
        response.write(true, ByteBuffer.wrap(body), callback);
    }
}
