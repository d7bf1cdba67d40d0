package io.furrow.dashboard;

import java.net.URI;
import java.time.Duration;
import java.util.concurrent.TimeUnit;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import org.eclipse.jetty.client.HttpClient;
import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.http.HttpHeaderValue;
import org.eclipse.jetty.http.HttpMethod;
import org.eclipse.jetty.http.HttpURI;
import org.eclipse.jetty.io.ByteBufferPool;
import org.eclipse.jetty.proxy.ProxyHandler;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.util.Callback;

import io.furrow.dashboard.http.Problem;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.TopicRules;

/**
 * Forwards requests to the control plane, and answers 502 if it does not respond. A server may close a connection just
 * when it is reused, for instance after rejecting a request without reading its body; then it is unknown whether the
 * request was processed. Therefore only reads share connections and are retried once.
 */
final class ControlPlaneProxy extends ProxyHandler.Reverse {
    /** Shorter than the time for which servers and proxies hold idle connections; that of Jetty is 30 s. */
    static final Duration IDLE_CONNECTION = Duration.ofSeconds(15);

    private static final Duration IDLE_REQUEST = Duration.ofSeconds(60);
    private static final String RETRIED = ControlPlaneProxy.class.getName() + ".retried";

    /** Records of a topic, under any name of the path that the control plane may take for it. */
    private static final Pattern RECORDS = Pattern.compile("/+api/+(?:v1/+)?topics/+([^/]+).*");

    private final URI controlPlane;
    private final TopicRules rules;

    ControlPlaneProxy(URI controlPlane, TopicRules rules) {
        super(request -> HttpURI.build(controlPlane + request.getHttpURI().getPathQuery())
                .asImmutable());
        this.controlPlane = controlPlane;
        this.rules = rules;
        setProxyToServerHost(controlPlane.getAuthority());
    }

    @Override
    public boolean handle(Request request, Response response, Callback callback) {
        Matcher records = RECORDS.matcher(request.getHttpURI().getDecodedPath());
        if (records.matches() && !rules.mayRead(records.group(1))) {
            new Problem(403, "topic-not-allowed", "'%s' may not be read here".formatted(records.group(1)))
                    .answer(response, callback);
            return true;
        }
        return super.handle(request, response, callback);
    }

    @Override
    protected HttpClient newHttpClient() {
        HttpClient client = super.newHttpClient();
        client.setIdleTimeout(IDLE_CONNECTION.toMillis());
        // From a pool, a response may lose the content that came with its head while other connections are closed.
        client.setByteBufferPool(ByteBufferPool.NON_POOLING);
        return client;
    }

    /** Removes the headers that describe the browser's page: the control plane is called by this process. */
    @Override
    protected void addProxyHeaders(Request request, org.eclipse.jetty.client.Request forwarded) {
        forwarded.idleTimeout(IDLE_REQUEST.toMillis(), TimeUnit.MILLISECONDS);
        forwarded.headers(headers -> {
            headers.remove(HttpHeader.ORIGIN);
            headers.remove(HttpHeader.COOKIE);
            headers.remove("Sec-Fetch-Site");
            headers.remove("Sec-Fetch-Mode");
            headers.remove("Sec-Fetch-Dest");
        });
        if (!sharesConnections(request)) {
            forwarded.tag("alone"); // a connection pool of its own, which retains no connection
            forwarded.headers(headers -> headers.put(HttpHeader.CONNECTION, HttpHeaderValue.CLOSE));
        }
    }

    private static boolean sharesConnections(Request request) {
        boolean reads = HttpMethod.GET.is(request.getMethod()) || HttpMethod.HEAD.is(request.getMethod());
        return reads && request.getAttribute(RETRIED) == null;
    }

    @Override
    protected void onServerToProxyResponseFailure(
            Request request,
            org.eclipse.jetty.client.Request forwarded,
            org.eclipse.jetty.client.Response serverResponse,
            Response response,
            Callback callback,
            Throwable failure) {
        boolean isUnanswered = serverResponse == null || serverResponse.getStatus() == 0;
        if (isUnanswered && sharesConnections(request)) {
            request.setAttribute(RETRIED, true);
            org.eclipse.jetty.client.Request retry = newProxyToServerRequest(request, rewriteHttpURI(request));
            copyRequestHeaders(request, retry);
            addProxyHeaders(request, retry);
            sendProxyToServerRequest(request, retry, response, callback);
        } else if (response.isCommitted()) {
            callback.failed(failure);
        } else {
            respondUnavailable(response, callback, failure);
        }
    }

    private void respondUnavailable(Response response, Callback callback, Throwable failure) {
        response.getHeaders().clear();
        String reason = "the control plane at %s does not answer (%s); check --control-plane and that it runs"
                .formatted(controlPlane, FailureText.of(failure));
        new Problem(502, "control-plane-away", reason).answer(response, callback);
    }
}
