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
 * Accepts requests with a valid token, and those for public resources. The file of tokens is reloaded when it changes;
 * while it is unusable, the previous tokens stay valid.
 */
@PreMatching
@Priority(Priorities.AUTHENTICATION)
public final class TokenFilter implements ContainerRequestFilter {
    /** Property of a request: its {@link ApiToken}. */
    public static final String TOKEN = "furrow.token";

    private static final Logger LOG = LoggerFactory.getLogger(TokenFilter.class);
    private static final Set<String> PUBLIC = Set.of("health", "ready", "metrics", "openapi.json");
    private static final Pattern HEADER = Pattern.compile("[Bb]earer +(\\S+) *");

    private final ReloadedFile<List<ApiToken>> tokens;

    private TokenFilter(ReloadedFile<List<ApiToken>> tokens) {
        this.tokens = tokens;
    }

    public static TokenFilter read(Path file) throws IOException {
        return new TokenFilter(ReloadedFile.open(List.of(file), () -> ApiToken.read(file), LOG::warn));
    }

    /** Returns why the current file is not in use; empty if it is. */
    Optional<String> problem() {
        tokens.get();
        return tokens.problem();
    }

    @Override
    public void filter(ContainerRequestContext request) {
        if (PUBLIC.contains(request.getUriInfo().getPath())) {
            return;
        }
        String header = request.getHeaderString("Authorization");
        Matcher bearer = HEADER.matcher(header == null ? "" : header);
        Optional<ApiToken> token = bearer.matches() ? ApiToken.find(tokens.get(), bearer.group(1)) : Optional.empty();
        if (token.isEmpty()) {
            String message = header == null ? "has no header 'Authorization: Bearer <token>'" : "has no valid token";
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
