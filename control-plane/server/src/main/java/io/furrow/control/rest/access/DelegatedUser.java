package io.furrow.control.rest.access;

import java.util.Optional;
import java.util.regex.Pattern;

import jakarta.ws.rs.container.ContainerRequestContext;

import io.furrow.model.control.Role;

/**
 * For whom a request is sent with a token that speaks for users: the headers {@value #USER} and {@value #ROLE}. The dashboard sends
 * them for users whom a proxy in front of it has signed in.
 */
final class DelegatedUser {
    static final String USER = "Furrow-User";
    static final String ROLE = "Furrow-Role";

    private static final Pattern NAME = Pattern.compile("[A-Za-z0-9_.@-]{1,64}");

    private DelegatedUser() {}

    /**
     * Who asks, and what they may: the token itself, or the user for whom it speaks.
     *
     * @throws ProblemException 403 where another token names a user, 400 where a token for users names none or no role
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
                    "the token of '%s' speaks for nobody else; only one whose line in the file of tokens ends with 'for-users' may send %s and %s"
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
        return token.speakingFor(user, userRole.get());
    }
}
