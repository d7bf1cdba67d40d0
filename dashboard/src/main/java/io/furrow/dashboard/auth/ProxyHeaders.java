package io.furrow.dashboard.auth;

import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.util.function.Consumer;

import org.eclipse.jetty.http.HttpFields;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.util.Callback;

import io.furrow.dashboard.http.Problem;

/**
 * Replaces the headers that name users. Removes them from every request; if a {@link TrustedProxy} sent the request and
 * names a user, adds the headers that the control plane accepts from the dashboard. All later handlers read only these.
 */
public final class ProxyHeaders extends Handler.Wrapper {
    private final TrustedProxy proxy;
    private final UserCache users;
    private final Consumer<Problem> onRejection;

    /**
     * @param proxy null if there is none
     * @param onRejection is notified of each rejected request
     */
    public ProxyHeaders(TrustedProxy proxy, UserCache users, Consumer<Problem> onRejection, Handler handler) {
        super(handler);
        this.proxy = proxy;
        this.users = users;
        this.onRejection = onRejection;
    }

    @Override
    public boolean handle(Request request, Response response, Callback callback) throws Exception {
        HttpFields headers;
        try {
            headers = replaceHeaders(request);
        } catch (Problem problem) {
            onRejection.accept(problem);
            problem.answer(response, callback);
            return true;
        }
        return super.handle(
                new Request.Wrapper(request) {
                    @Override
                    public HttpFields getHeaders() {
                        return headers;
                    }
                },
                response,
                callback);
    }

    private HttpFields replaceHeaders(Request request) {
        HttpFields received = request.getHeaders();
        HttpFields.Mutable headers = HttpFields.build(received);
        headers.remove(Credentials.USER);
        headers.remove(Credentials.ROLE);
        if (proxy == null) {
            return headers.asImmutable();
        }
        headers.remove(proxy.userHeader());
        headers.remove(proxy.groupsHeader());
        boolean isApi = Request.getPathInContext(request).startsWith("/api/"); // the page itself is public
        if (isApi && received.contains(proxy.userHeader()) && proxy.isAt(address(request))) {
            User user = proxy.user(
                    received.getValuesList(proxy.userHeader()), received.getValuesList(proxy.groupsHeader()));
            headers.put(Credentials.AUTHORIZATION, "Bearer " + proxy.token());
            headers.put(Credentials.USER, user.name());
            headers.put(Credentials.ROLE, user.role().code());
            // fails if the control plane is too old to know these headers: it would treat every user as the dashboard,
            // or as an admin
            users.find(Credentials.of(headers, Request.getRemoteAddr(request)));
        }
        return headers.asImmutable();
    }

    /** The peer of the connection; headers are not considered. */
    private static InetAddress address(Request request) {
        return request.getConnectionMetaData().getRemoteSocketAddress() instanceof InetSocketAddress socket
                ? socket.getAddress()
                : null;
    }
}
