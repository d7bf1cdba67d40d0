package io.furrow.control.rest.access;

import java.util.UUID;
import java.util.regex.Pattern;

import jakarta.ws.rs.container.ContainerRequestContext;

/**
 * The caller and the id of a request.
 *
 * @param user for the audit
 * @param requestId value of the header {@value #KEY}, else a new id
 */
public record RequestContext(String user, String requestId) {
    public static final String KEY = "Idempotency-Key";
    /** The user if no token is required. */
    static final String ANONYMOUS = "rest";

    private static final Pattern REQUEST_ID = Pattern.compile("[!-~]{1,200}");

    public static RequestContext of(ContainerRequestContext request) {
        String key = request.getHeaderString(KEY);
        if (key != null && !REQUEST_ID.matcher(key).matches()) {
            throw new ProblemException(
                    400, "wrong-header", KEY + " must be 1 to 200 printable ASCII characters without spaces");
        }
        return new RequestContext(user(request), key == null ? UUID.randomUUID().toString() : key);
    }

    public static String user(ContainerRequestContext request) {
        return request.getProperty(TokenFilter.TOKEN) instanceof ApiToken token ? token.name() : ANONYMOUS;
    }
}
