package io.furrow.control.rest.access;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.MessageDigest;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.control.Role;
import io.furrow.model.file.FileProblem;
import io.furrow.model.file.PrivateFile;

/**
 * A token of the REST API. A name may have several tokens, so that they can be rotated.
 *
 * @param name of its owner, as used on the audit topic
 * @param secret not part of {@link #toString()}
 * @param role permissions of its owner
 * @param forUsers whether it acts on behalf of users named in each request, with at most the permissions of
 *     {@code role}; then it cannot be used without a user
 */
public record ApiToken(String name, byte[] secret, Role role, boolean forUsers) {
    private static final Logger LOG = LoggerFactory.getLogger(ApiToken.class);
    private static final Pattern LINE =
            Pattern.compile("([A-Za-z0-9_.@-]{1,64})\\s+(\\S{16,512})(?:\\s+(\\S+))?(\\s+for-users)?");

    /**
     * Reads lines {@code <name> <token> <role>}; empty lines and those that begin with # are skipped. The default role
     * is viewer. A line may end with {@code for-users}.
     *
     * @throws IOException if the file cannot be read, contains another line, a duplicate token or no token; the message
     *     names the line
     */
    static List<ApiToken> read(Path file) throws IOException {
        List<ApiToken> tokens = new ArrayList<>();
        Set<String> secrets = new HashSet<>();
        List<String> lines = lines(file);
        for (int i = 0; i < lines.size(); i++) {
            String line = lines.get(i).strip();
            if (line.isEmpty() || line.startsWith("#")) {
                continue;
            }
            Matcher parts = LINE.matcher(line);
            if (!parts.matches()) {
                throw wrong(file, i, "a line is '<name> <token> <role>', the token at least 16 characters long");
            }
            if (!secrets.add(parts.group(2))) {
                throw wrong(file, i, "an earlier line has the same token; each line needs its own");
            }
            tokens.add(new ApiToken(
                    parts.group(1),
                    parts.group(2).getBytes(StandardCharsets.UTF_8),
                    role(file, i, parts),
                    parts.group(4) != null));
        }
        if (tokens.isEmpty()) {
            throw new IOException(file + " holds no token; add a line '<name> <token> <role>'");
        }
        PrivateFile.exposure(file).ifPresent(LOG::warn);
        return List.copyOf(tokens);
    }

    private static List<String> lines(Path file) throws IOException {
        try {
            return Files.readAllLines(file);
        } catch (IOException e) {
            throw new IOException("the file of tokens %s cannot be read (%s)".formatted(file, FileProblem.of(e)), e);
        }
    }

    private static Role role(Path file, int index, Matcher parts) throws IOException {
        if (parts.group(3) == null) {
            LOG.warn(
                    "{}, line {}: '{}' has no role and may only read; add viewer, operator or admin",
                    file,
                    index + 1,
                    parts.group(1));
            return Role.VIEWER;
        }
        return Role.of(parts.group(3))
                .orElseThrow(() -> wrong(
                        file, index, "'%s' is not a role; it is viewer, operator or admin".formatted(parts.group(3))));
    }

    private static IOException wrong(Path file, int index, String reason) {
        return new IOException("%s, line %d: %s".formatted(file, index + 1, reason));
    }

    /** Returns the token for a user on whose behalf this one acts. */
    ApiToken onBehalfOf(String user, Role userRole) {
        return new ApiToken(user, secret, role.includes(userRole) ? userRole : role, false);
    }

    /** Finds the token with a secret, in constant time. */
    static Optional<ApiToken> find(List<ApiToken> tokens, String secret) {
        byte[] candidate = secret.getBytes(StandardCharsets.UTF_8);
        ApiToken found = null;
        for (ApiToken each : tokens) {
            if (MessageDigest.isEqual(each.secret, candidate)) {
                found = each;
            }
        }
        return Optional.ofNullable(found);
    }

    @Override
    public String toString() {
        return name + " (" + role.code() + ")";
    }
}
