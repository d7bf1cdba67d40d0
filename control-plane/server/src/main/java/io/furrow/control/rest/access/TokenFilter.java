package io.furrow.control.rest.access;

import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import jakarta.annotation.Priority;
import jakarta.ws.rs.Priorities;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.ContainerRequestFilter;
import jakarta.ws.rs.container.PreMatching;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.file.ReloadedFile;

/**
 * Accepts requests with one of the tokens, and those for resources that show nothing of the farm. The file of tokens
 * is read again when it changes; as long as it cannot be used, the tokens from before count.
 */
@PreMatching
@Priority(Priorities.AUTHENTICATION)
public final class TokenFilter implements ContainerRequestFilter {
    /** Property of a request: its {@link ApiToken}. */
    public static final String TOKEN = "furrow.token";

    private static final Logger LOG = LoggerFactory.getLogger(TokenFilter.class);
    private static final Set<String> OPEN = Set.of("health", "ready", "metrics", "openapi.json");
    private static final Pattern HEADER = Pattern.compile("[Bb]earer +(\\S+) *");

    private final ReloadedFile<List<ApiToken>> tokens;

    private TokenFilter(ReloadedFile<List<ApiToken>> tokens) {
        this.tokens = tokens;
    }

    /** @throws IOException as {@link ApiToken#read} */
    public static TokenFilter read(Path file) throws IOException {
        return new TokenFilter(ReloadedFile.open(List.of(file), () -> ApiToken.read(file), LOG::warn));
    }

    /** Why the file as it is now is not in use; empty if it is. */
    Optional<String> problem() {
        tokens.get();
        return tokens.problem();
    }

    @Override
    public void filter(ContainerRequestContext request) {
        if (OPEN.contains(request.getUriInfo().getPath())) {
            return;
        }
        String header = request.getHeaderString("Authorization");
        Matcher bearer = HEADER.matcher(header == null ? "" : header);
        Optional<ApiToken> token = bearer.matches() ? ApiToken.find(tokens.get(), bearer.group(1)) : Optional.empty();
        if (token.isEmpty()) {
            String message =
                    header == null ? "has no header 'Authorization: Bearer <token>'" : "has no token that is known";
            request.abortWith(new ProblemException(401, "unauthorized", "the request " + message).response());
        } else {
            try {
                request.setProperty(TOKEN, DelegatedUser.caller(request, token.get()));
            } catch (ProblemException problem) {
                request.abortWith(problem.response());
            }
        }
    }
}
