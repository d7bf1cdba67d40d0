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
 * Removes the headers by which users are named from every request. Where a {@link TrustedProxy} sent it and names a user, those that
 * the control plane takes from the dashboard stand in their place, so that all that follows reads the same headers.
 */
public final class ProxyHeaders extends Handler.Wrapper {
    private final TrustedProxy proxy;
    private final UserCache users;
    private final Consumer<Problem> refused;

    /**
     * @param proxy null if there is none
     * @param refused is notified of each request that is refused
     */
    public ProxyHeaders(TrustedProxy proxy, UserCache users, Consumer<Problem> refused, Handler handler) {
        super(handler);
        this.proxy = proxy;
        this.users = users;
        this.refused = refused;
    }

    @Override
    public boolean handle(Request request, Response response, Callback callback) throws Exception {
        HttpFields headers;
        try {
            headers = replaced(request);
        } catch (Problem problem) {
            refused.accept(problem);
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

    private HttpFields replaced(Request request) {
        HttpFields given = request.getHeaders();
        HttpFields.Mutable headers = HttpFields.build(given);
        headers.remove(Credentials.USER);
        headers.remove(Credentials.ROLE);
        if (proxy == null) {
            return headers.asImmutable();
        }
        headers.remove(proxy.userHeader());
        headers.remove(proxy.groupsHeader());
        boolean isApi = Request.getPathInContext(request).startsWith("/api/"); // the page itself is everybody's
        if (isApi && given.contains(proxy.userHeader()) && proxy.isAt(address(request))) {
            User user = proxy.user(given.getValuesList(proxy.userHeader()), given.getValuesList(proxy.groupsHeader()));
            headers.put(Credentials.AUTHORIZATION, "Bearer " + proxy.token());
            headers.put(Credentials.USER, user.name());
            headers.put(Credentials.ROLE, user.role().code());
            // a control plane that does not know these headers would take everybody for the dashboard, or for an admin
            users.find(Credentials.of(headers, Request.getRemoteAddr(request)));
        }
        return headers.asImmutable();
    }

    /** The other end of the connection, whatever headers say. */
    private static InetAddress address(Request request) {
        return request.getConnectionMetaData().getRemoteSocketAddress() instanceof InetSocketAddress socket
                ? socket.getAddress()
                : null;
    }
}
