package io.furrow.http;

import java.util.Locale;
import java.util.Optional;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/**
 * Where a page comes from (RFC 6454).
 *
 * @param port the scheme's own where none is named
 */
record Origin(String scheme, String host, int port) {
    private static final Pattern FORM = Pattern.compile("([A-Za-z][A-Za-z0-9+.-]{0,30})://(.+)");

    /** Empty for what is not an origin, {@code null} among it. */
    static Optional<Origin> parse(String text) {
        Matcher form = FORM.matcher(text);
        if (!form.matches()) {
            return Optional.empty();
        }
        String scheme = form.group(1).toLowerCase(Locale.ROOT);
        return Authority.parse(form.group(2)).map(authority -> of(scheme, authority));
    }

    static Origin of(String scheme, Authority authority) {
        int port = authority.port() != Authority.NO_PORT ? authority.port() : usualPort(scheme);
        return new Origin(scheme, authority.host(), port);
    }

    private static int usualPort(String scheme) {
        return switch (scheme) {
            case "http" -> 80;
            case "https" -> 443;
            default -> Authority.NO_PORT;
        };
    }

    @Override
    public String toString() {
        String printed = host.indexOf(':') < 0 ? host : "[" + host + "]";
        return scheme + "://" + printed + (port == usualPort(scheme) ? "" : ":" + port);
    }
}
