package io.furrow.dashboard.status;

import java.nio.ByteBuffer;

import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.http.HttpMethod;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.util.Callback;

import io.furrow.dashboard.http.Problem;
import io.furrow.dashboard.proxy.TopicStreams;
import io.furrow.http.prometheus.MetricsPage;
import io.furrow.kafka.Readiness;
import io.furrow.model.ngsi.NgsiJson;

/**
 * {@code GET /health}, {@code /ready} and {@code /metrics} of the dashboard itself, without a token. It is alive while
 * it answers; ready (200, else 503) if Kafka and the control plane answer too.
 */
public final class StatusPages extends Handler.Abstract {
    public static final String HEALTH = "/health";
    public static final String READY = "/ready";
    public static final String METRICS = "/metrics";

    private final Readiness readiness;
    private final TopicStreams streams;

    public StatusPages(Readiness readiness, TopicStreams streams) {
        this.readiness = readiness;
        this.streams = streams;
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
                response.getHeaders().put(HttpHeader.CONTENT_TYPE, MetricsPage.CONTENT_TYPE);
                response.write(true, ByteBuffer.wrap(StreamMetrics.page(streams)), callback);
            }
            default -> json(response, callback, NgsiJson.write(readiness.health()));
        }
        return true;
    }

    private void ready(Response response, Callback callback) {
        if (!readiness.isReady()) {
            response.setStatus(503);
            response.getHeaders().put(HttpHeader.RETRY_AFTER, "1");
        }
        json(response, callback, NgsiJson.write(readiness.readiness()));
    }

    private static void json(Response response, Callback callback, byte[] body) {
        response.getHeaders().put(HttpHeader.CONTENT_TYPE, "application/json");
        response.getHeaders().put(HttpHeader.CACHE_CONTROL, "no-store");
        response.write(true, ByteBuffer.wrap(body), callback);
    }
}
