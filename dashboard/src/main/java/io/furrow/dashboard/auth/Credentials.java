package io.furrow.dashboard.auth;

import java.net.http.HttpRequest;

import jakarta.servlet.http.HttpServletRequest;
import org.eclipse.jetty.http.HttpFields;

/**
 * By what a request says who sends it. A user and a role stand there only where a {@link TrustedProxy} named them; those that a
 * client sends are removed before.
 *
 * @param authorization header of the request; null if it has none
 * @param user for whom the dashboard's own token speaks; null if the token is the user's own
 * @param role that the user may have at most; null without a user
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

    /** Whose streams and tickets are counted together: all clients of a proxy have one address. */
    public String client() {
        return user == null ? address : "user " + user;
    }

    /** Whether a proxy signed the user in, which can end without that the control plane knows. */
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

    /** The token is left out: this ends in logs. */
    @Override
    public String toString() {
        return client();
    }
}
