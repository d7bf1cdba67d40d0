package io.furrow.cli.control.client;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.Optional;

/** Finds the token for requests to the control plane. */
final class ClientToken {
    private static final String TOKEN = "FURROW_TOKEN";
    private static final String TOKEN_FILE = "FURROW_TOKEN_FILE";

    private ClientToken() {}

    /**
     * Reads the token from a file, else from the variable {@value #TOKEN}, else from the file that {@value #TOKEN_FILE}
     * names.
     *
     * @param file null if no file is named
     * @throws IOException if the file cannot be read or holds no token; the message says what to do
     */
    static Optional<String> find(Path file, Map<String, String> environment) throws IOException {
        if (file != null) {
            return Optional.of(read("--token-file", file));
        }
        String token = environment.getOrDefault(TOKEN, "").strip();
        if (!token.isEmpty()) {
            return Optional.of(token);
        }
        String named = environment.getOrDefault(TOKEN_FILE, "").strip();
        return named.isEmpty() ? Optional.empty() : Optional.of(read("$" + TOKEN_FILE, Path.of(named)));
    }

    private static String read(String origin, Path file) throws IOException {
        List<String> lines;
        try {
            lines = Files.readAllLines(file);
        } catch (IOException e) {
            throw new IOException(
                    "%s %s cannot be read; name a file whose first line is the token".formatted(origin, file), e);
        }
        for (String line : lines) {
            String[] arguments = line.strip().split("\\s+");
            if (!arguments[0].isEmpty() && !arguments[0].startsWith("#")) {
                return arguments.length == 1 ? arguments[0] : arguments[1];
            }
        }
        throw new IOException(
                "%s %s holds no token; its first line is a token, or '<name> <token> <role>'".formatted(origin, file));
    }
}
