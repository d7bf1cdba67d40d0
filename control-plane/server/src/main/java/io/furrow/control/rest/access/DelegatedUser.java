package io.furrow.control.rest.access;

import java.util.Optional;
import java.util.regex.Pattern;

import jakarta.ws.rs.container.ContainerRequestContext;

import io.furrow.model.control.Role;

/**
 * Evaluates the headers {@value #USER} and {@value #ROLE} of requests with a token that acts on behalf of users. The
 * dashboard sends them for users that its proxy has authenticated.
 */
final class DelegatedUser {
    static final String USER = "Furrow-User";
    static final String ROLE = "Furrow-Role";

    private static final Pattern NAME = Pattern.compile("[A-Za-z0-9_.@-]{1,64}");

    private DelegatedUser() {}

    /**
     * Returns the caller and its permissions: the token itself, or the user on whose behalf it acts.
     *
     * @throws ProblemException 403 if another token names a user, 400 if a token for users names no user or no role
     */
    static ApiToken caller(ContainerRequestContext request, ApiToken token) {
        String user = request.getHeaderString(USER);
        String role = request.getHeaderString(ROLE);
        if (!token.forUsers()) {
            if (user == null && role == null) {
                return token;
            }
            throw new ProblemException(
                    403,
                    "not-for-users",
                    "the token of '%s' may not act for other users; only a token whose line in the token file ends with 'for-users' may send %s and %s"
                            .formatted(token.name(), USER, ROLE));
        }
        Optional<Role> userRole = role == null ? Optional.empty() : Role.of(role);
        if (user == null || !NAME.matcher(user).matches() || userRole.isEmpty()) {
            throw new ProblemException(
                    400,
                    "wrong-header",
                    "the token of '%s' speaks for users: %s must be a name of 1 to 64 of A-Z a-z 0-9 _ . @ -, and %s viewer, operator or admin"
                            .formatted(token.name(), USER, ROLE));
        }
        return token.onBehalfOf(user, userRole.get());
    }
}
