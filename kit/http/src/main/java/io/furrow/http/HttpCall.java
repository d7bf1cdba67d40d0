package io.furrow.http;

import java.net.InetAddress;
import java.util.List;
import java.util.Optional;
import java.util.function.Function;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/**
 * The parts of a request that {@link AccessRule} checks.
 *
 * @param target as received: a path with or without a query, or a whole URI
 * @param secure whether it was received over TLS
 * @param local the server's address of the connection; null if unknown
 * @param headers returns the values of a header by its name in any case; empty if there is none
 */
public record HttpCall(
        String method, String target, boolean secure, InetAddress local, Function<String, List<String>> headers) {
    private static final Pattern ABSOLUTE = Pattern.compile("[A-Za-z][A-Za-z0-9+.-]*://([^/?#]*)(.*)");

    boolean isRead() {
        return method.equals("GET") || method.equals("HEAD");
    }

    /** Returns whether it is a CORS preflight request. */
    boolean isPreflight() {
        return method.equals("OPTIONS")
                && header("Access-Control-Request-Method").isPresent();
    }

    String scheme() {
        return secure ? "https" : "http";
    }

    /** Returns the path without the query. */
    String path() {
        Matcher absolute = ABSOLUTE.matcher(target);
        String path = absolute.matches() ? absolute.group(2) : target;
        return path.split("[?#]", 2)[0];
    }

    /** Returns the host and port of a whole URI; empty for a path. */
    static Optional<String> authorityOf(String uri) {
        Matcher absolute = ABSOLUTE.matcher(uri);
        return absolute.matches() ? Optional.of(absolute.group(1)) : Optional.empty();
    }

    List<String> values(String header) {
        return headers.apply(header);
    }

    Optional<String> header(String name) {
        return values(name).stream().findFirst();
    }
}
