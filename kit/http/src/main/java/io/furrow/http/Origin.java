package io.furrow.http;

import java.util.Locale;
import java.util.Optional;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/**
 * The origin of a page (RFC 6454).
 *
 * @param port the scheme's default if none is given
 */
record Origin(String scheme, String host, int port) {
    private static final Pattern FORM = Pattern.compile("([A-Za-z][A-Za-z0-9+.-]{0,30})://(.+)");

    /** Parses an origin; empty if it is invalid, as {@code null} is. */
    static Optional<Origin> parse(String text) {
        Matcher form = FORM.matcher(text);
        if (!form.matches()) {
            return Optional.empty();
        }
        String scheme = form.group(1).toLowerCase(Locale.ROOT);
        return Authority.parse(form.group(2)).map(authority -> of(scheme, authority));
    }

    static Origin of(String scheme, Authority authority) {
        int port = authority.port() != Authority.NO_PORT ? authority.port() : defaultPort(scheme);
        return new Origin(scheme, authority.host(), port);
    }

    private static int defaultPort(String scheme) {
        return switch (scheme) {
            case "http" -> 80;
            case "https" -> 443;
            default -> Authority.NO_PORT;
        };
    }

    @Override
    public String toString() {
        String printed = host.indexOf(':') < 0 ? host : "[" + host + "]";
        return scheme + "://" + printed + (port == defaultPort(scheme) ? "" : ":" + port);
    }
}
