package io.furrow.control.rest;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.MessageDigest;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import jakarta.annotation.Priority;
import jakarta.ws.rs.Priorities;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.ContainerRequestFilter;
import jakarta.ws.rs.container.PreMatching;

/** Lets requests pass that have one of the tokens, whose name is the user, and those for what tells nothing of the farm. */
@PreMatching
@Priority(Priorities.AUTHENTICATION)
final class BearerTokens implements ContainerRequestFilter {
    /** Property of a request: the name of its token. */
    static final String USER = "furrow.user";

    private static final Set<String> OPEN = Set.of("health", "metrics", "openapi.json");
    private static final Pattern LINE = Pattern.compile("([A-Za-z0-9_.@-]{1,64})\\s+(\\S{16,512})");
    private static final Pattern HEADER = Pattern.compile("[Bb]earer +(\\S+) *");

    private final Map<String, byte[]> tokens;

    private BearerTokens(Map<String, byte[]> tokens) {
        this.tokens = tokens;
    }

    /**
     * Reads lines {@code <name> <token>}; empty ones and those that begin with # are passed over.
     *
     * @throws IOException if the file cannot be read, has another line, or no token; the message names the line
     */
    static BearerTokens read(Path file) throws IOException {
        Map<String, byte[]> tokens = new LinkedHashMap<>();
        List<String> lines = Files.readAllLines(file);
        for (int i = 0; i < lines.size(); i++) {
            String line = lines.get(i).strip();
            Matcher found = LINE.matcher(line);
            if (found.matches()) {
                tokens.put(found.group(1), found.group(2).getBytes(StandardCharsets.UTF_8));
            } else if (!line.isEmpty() && !line.startsWith("#")) {
                throw new IOException("%s, line %d: a line is '<name> <token>', the token at least 16 signs long"
                        .formatted(file, i + 1));
            }
        }
        if (tokens.isEmpty()) {
            throw new IOException(file + " holds no token; add a line '<name> <token>'");
        }
        return new BearerTokens(tokens);
    }

    @Override
    public void filter(ContainerRequestContext request) {
        if (OPEN.contains(request.getUriInfo().getPath())) {
            return;
        }
        String header = request.getHeaderString("Authorization");
        Matcher bearer = HEADER.matcher(header == null ? "" : header);
        Optional<String> name = bearer.matches() ? nameOf(bearer.group(1)) : Optional.empty();
        if (name.isEmpty()) {
            String said =
                    header == null ? "has no header 'Authorization: Bearer <token>'" : "has no token that is known";
            request.abortWith(Replies.problem(new ProblemException(401, "unauthorized", "the request " + said)));
        } else {
            request.setProperty(USER, name.get());
        }
    }

    /** In a time that does not tell how much of a token is right. */
    private Optional<String> nameOf(String token) {
        byte[] given = token.getBytes(StandardCharsets.UTF_8);
        String name = null;
        for (Map.Entry<String, byte[]> each : tokens.entrySet()) {
            if (MessageDigest.isEqual(each.getValue(), given)) {
                name = each.getKey();
            }
        }
        return Optional.ofNullable(name);
    }
}
