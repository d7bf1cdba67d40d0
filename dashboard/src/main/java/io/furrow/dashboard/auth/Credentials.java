package io.furrow.dashboard.auth;

import java.net.http.HttpRequest;

import jakarta.servlet.http.HttpServletRequest;
import org.eclipse.jetty.http.HttpFields;

/**
 * The credentials of a request. User and role are set only if a {@link TrustedProxy} named them; headers of clients
 * with these names are removed before.
 *
 * @param authorization header of the request; null if absent
 * @param user for whom the dashboard's own token is used; null if the token is the user's own
 * @param role the highest that the user may have; null without a user
 * @param address of the client, or of the proxy
 */
public record Credentials(String authorization, String user, String role, String address) {
    static final String AUTHORIZATION = "Authorization";
    static final String USER = "Furrow-User";
    static final String ROLE = "Furrow-Role";

    public static Credentials of(HttpServletRequest request) {
        return new Credentials(
                request.getHeader(AUTHORIZATION),
                request.getHeader(USER),
                request.getHeader(ROLE),
                request.getRemoteAddr());
    }

    static Credentials of(HttpFields headers, String address) {
        return new Credentials(headers.get(AUTHORIZATION), headers.get(USER), headers.get(ROLE), address);
    }

    /** Identifies the client for quotas: all users of a proxy have the same address. */
    public String client() {
        return user == null ? address : "user " + user;
    }

    /** Whether a proxy signed the user in; the control plane does not learn when this ends. */
    public boolean isOfProxy() {
        return user != null;
    }

    void addTo(HttpRequest.Builder request) {
        if (authorization != null) {
            request.header(AUTHORIZATION, authorization);
        }
        if (user != null) {
            request.header(USER, user).header(ROLE, role);
        }
    }

    /** Leaves out the token, since this text appears in logs. */
    @Override
    public String toString() {
        return client();
    }
}
