package io.furrow.http.jetty;

import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.nio.ByteBuffer;
import java.util.function.Function;

import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.http.HttpStatus;
import org.eclipse.jetty.http.UriCompliance;
import org.eclipse.jetty.io.Content;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.HttpConfiguration;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.util.Callback;

import io.furrow.http.AccessRule;
import io.furrow.http.Decision;
import io.furrow.http.HttpCall;

/** Applies an {@link AccessRule} to all requests of a Jetty server before the wrapped handler. */
public final class AccessHandler extends Handler.Wrapper {
    /** A body up to this size is read first: a client that still sends may lose an answer to a closed connection. */
    private static final int MAX_DRAINED = 64 * 1024;

    /** Allows {@code %25}: the id of an entity may be a URI, in which a blank is {@code %20}. */
    private static final UriCompliance IDS_IN_PATHS =
            UriCompliance.DEFAULT.with("ids", UriCompliance.Violation.AMBIGUOUS_PATH_ENCODING);

    private final AccessRule rule;
    private final String type;
    private final Function<Decision.Refused, byte[]> body;

    /** @param body composes the JSON of a rejection */
    public AccessHandler(AccessRule rule, Function<Decision.Refused, byte[]> body, Handler handler) {
        this(rule, "application/json", body, handler);
    }

    /** @param type media type of a rejection @param body composes it */
    public AccessHandler(AccessRule rule, String type, Function<Decision.Refused, byte[]> body, Handler handler) {
        super(handler);
        this.rule = rule;
        this.type = type;
        this.body = body;
    }

    /** Returns the configuration of a server that has ids of entities in its paths. */
    public static HttpConfiguration configuration() {
        HttpConfiguration configuration = new HttpConfiguration();
        configuration.setSendServerVersion(false);
        configuration.setUriCompliance(IDS_IN_PATHS);
        return configuration;
    }

    @Override
    public boolean handle(Request request, Response response, Callback callback) throws Exception {
        Decision decision = rule.decide(call(request));
        if (decision instanceof Decision.Granted granted) {
            granted.headers().forEach(response.getHeaders()::put);
            return super.handle(request, response, callback);
        }
        if (decision instanceof Decision.Preflight preflight) {
            preflight.headers().forEach(response.getHeaders()::put);
            response.setStatus(HttpStatus.NO_CONTENT_204);
            response.write(true, null, callback);
        } else if (decision instanceof Decision.Refused refused) {
            reject(request, response, refused, callback);
        }
        return true;
    }

    private void reject(Request request, Response response, Decision.Refused refused, Callback callback) {
        response.setStatus(Decision.REFUSED_STATUS);
        response.getHeaders().put(HttpHeader.CONTENT_TYPE, type);
        response.getHeaders().put(HttpHeader.CONNECTION, "close");
        ByteBuffer json = ByteBuffer.wrap(body.apply(refused));
        if (request.getLength() > 0 && request.getLength() <= MAX_DRAINED) {
            Content.Source.consumeAll(
                    request, Callback.from(() -> response.write(true, json, callback), callback::failed));
        } else {
            response.write(true, json, callback);
        }
    }

    private static HttpCall call(Request request) {
        InetAddress local = request.getConnectionMetaData().getLocalSocketAddress() instanceof InetSocketAddress address
                ? address.getAddress()
                : null;
        return new HttpCall(
                request.getMethod(),
                request.getHttpURI().asString(),
                request.isSecure(),
                local,
                request.getHeaders()::getValuesList);
    }
}
