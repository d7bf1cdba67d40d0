package io.furrow.dashboard;

import java.net.URI;
import java.time.Duration;
import java.util.concurrent.TimeUnit;

import org.eclipse.jetty.client.HttpClient;
import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.http.HttpHeaderValue;
import org.eclipse.jetty.http.HttpMethod;
import org.eclipse.jetty.http.HttpURI;
import org.eclipse.jetty.proxy.ProxyHandler;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.util.Callback;

import io.furrow.dashboard.http.Problem;
import io.furrow.model.text.FailureText;

/**
 * Forwards requests to the control plane, and answers 502 where it does not answer. A server may close a connection at the moment it is
 * used again, as after a refusal that did not wait for the body, and then nobody knows whether it has processed the request: only reads
 * share connections, and are sent once more.
 */
final class ControlPlaneProxy extends ProxyHandler.Reverse {
    /** Shorter than servers and proxies keep idle connections; Jetty does for 30 s. */
    static final Duration IDLE_CONNECTION = Duration.ofSeconds(15);

    private static final Duration IDLE_REQUEST = Duration.ofSeconds(60);
    private static final String RETRIED = ControlPlaneProxy.class.getName() + ".retried";

    private final URI base;

    ControlPlaneProxy(URI base) {
        super(request -> HttpURI.build(base.toString().replaceAll("/+$", "")
                        + request.getHttpURI().getPathQuery())
                .asImmutable());
        this.base = base;
        setProxyToServerHost(base.getAuthority());
    }

    @Override
    protected HttpClient newHttpClient() {
        HttpClient client = super.newHttpClient();
        client.setIdleTimeout(IDLE_CONNECTION.toMillis());
        return client;
    }

    /** The page's own origin means nothing to the control plane, which is asked by this process. */
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
            forwarded.tag("alone"); // another pool, in which no connection is left
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
            org.eclipse.jetty.client.Response answer,
            Response response,
            Callback callback,
            Throwable failure) {
        boolean unanswered = answer == null || answer.getStatus() == 0;
        if (unanswered && sharesConnections(request)) {
            request.setAttribute(RETRIED, true);
            org.eclipse.jetty.client.Request again = newProxyToServerRequest(request, rewriteHttpURI(request));
            copyRequestHeaders(request, again);
            addProxyHeaders(request, again);
            sendProxyToServerRequest(request, again, response, callback);
        } else if (response.isCommitted()) {
            callback.failed(failure);
        } else {
            unavailable(response, callback, failure);
        }
    }

    private void unavailable(Response response, Callback callback, Throwable failure) {
        response.getHeaders().clear();
        String reason = "the control plane at %s does not answer (%s); check --control-plane and that it runs"
                .formatted(base, FailureText.of(failure));
        new Problem(502, "control-plane-away", reason).answer(response, callback);
    }
}
