package io.furrow.model.file;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.function.BiConsumer;
import java.util.function.Consumer;
import java.util.function.Supplier;

/**
 * Adds a header with a token for a proxy in front of a server, such as a Wilma PEP proxy. The token is the first line
 * of a file, which is read again when it changes; while it is invalid, the previous token is sent.
 */
public final class AccessToken {
    /** The header of a Wilma PEP proxy. */
    public static final String DEFAULT_HEADER = "X-Auth-Token";

    public static final AccessToken NONE = new AccessToken(null, () -> "");

    /** Valid names, except those of headers that HTTP clients set themselves. */
    private static final String HEADER =
            "(?i)(?!(connection|content-length|expect|host|upgrade)$)[A-Za-z0-9!#$%&'*+.^_`|~-]+";

    private final String header;
    private final Supplier<String> token;

    private AccessToken(String header, Supplier<String> token) {
        this.header = header;
        this.token = token;
    }

    /**
     * @param header null for {@value #DEFAULT_HEADER}
     * @param warning receives a message if a changed file cannot be used, or if everybody may read it
     * @throws IOException if the file has no token or the header is invalid; the message says what to do
     */
    public static AccessToken of(Path file, String header, Consumer<String> warning) throws IOException {
        if (header != null && !header.matches(HEADER)) {
            throw new IOException("'%s' is not a header that can carry a token; name for instance %s or Authorization"
                    .formatted(header, DEFAULT_HEADER));
        }
        ReloadedFile<String> token = ReloadedFile.open(List.of(file), () -> read(file), warning);
        PrivateFile.exposure(file).ifPresent(warning);
        return new AccessToken(header == null ? DEFAULT_HEADER : header, token);
    }

    private static String read(Path file) throws IOException {
        String token;
        try {
            token = Files.readString(file).lines().findFirst().orElse("").strip();
        } catch (IOException e) {
            throw new IOException("%s cannot be read; name a file whose first line is the token".formatted(file), e);
        }
        if (!token.matches("[!-~][ -~]*")) {
            throw new IOException(
                    "%s holds no token: its first line must be visible ASCII and not empty".formatted(file));
        }
        return token;
    }

    /** Sets the header if there is a token. */
    public void addTo(BiConsumer<String, String> request) {
        if (header != null) {
            request.accept(header, token.get());
        }
    }

    /** Returns a description without the token. */
    @Override
    public String toString() {
        return header == null ? "no token" : "a token in " + header;
    }
}
