package io.furrow.http;

import java.net.InetAddress;
import java.net.UnknownHostException;
import java.util.Locale;
import java.util.Optional;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/**
 * The host and port of a {@code Host} header, a request target or an origin.
 *
 * @param host in lower case and without a trailing dot; an address in the form that Java prints
 * @param port {@value #NO_PORT} if none is given
 */
record Authority(String host, int port) {
    static final int NO_PORT = -1;

    private static final String LOCALHOST = "localhost";
    private static final int MAX_PORT = 65535;
    private static final Pattern FORM =
            Pattern.compile("(\\[[0-9A-Fa-f:.]{2,45}]|[A-Za-z0-9._-]{1,255})(?::([0-9]{0,5}))?");
    private static final Pattern OCTETS = Pattern.compile("(?:(?:0|[1-9][0-9]{0,2})(?:\\.|$)){4}");

    /** Parses a host with or without a port; empty if it is invalid. Resolves no name. */
    static Optional<Authority> parse(String text) {
        Matcher form = FORM.matcher(text);
        if (!form.matches()) {
            return Optional.empty();
        }
        String digits = form.group(2);
        int port = digits == null || digits.isEmpty() ? NO_PORT : Integer.parseInt(digits);
        if (port > MAX_PORT) {
            return Optional.empty();
        }
        return host(form.group(1)).map(host -> new Authority(host, port));
    }

    /** Normalizes a host for comparison. */
    private static Optional<String> host(String text) {
        if (isLiteral(text)) {
            return address(text).map(InetAddress::getHostAddress);
        }
        String name = text.endsWith(".") ? text.substring(0, text.length() - 1) : text;
        return name.isEmpty() ? Optional.empty() : Optional.of(name.toLowerCase(Locale.ROOT));
    }

    private static boolean isLiteral(String text) {
        return text.startsWith("[") || OCTETS.matcher(text).matches();
    }

    /** @param literal IPv4 with four numbers, or IPv6 in brackets; Java resolves both without a name server */
    private static Optional<InetAddress> address(String literal) {
        try {
            return Optional.of(InetAddress.getByName(literal));
        } catch (UnknownHostException e) {
            return Optional.empty();
        }
    }

    /** Returns whether it can only be this machine: {@code localhost}, 127.0.0.0/8 or ::1. */
    boolean isLoopback() {
        String literal = host.indexOf(':') < 0 ? host : "[" + host + "]";
        return host.equals(LOCALHOST)
                || isLiteral(literal)
                        && address(literal)
                                .filter(InetAddress::isLoopbackAddress)
                                .isPresent();
    }

    /** Returns whether it is this address, written as a number, so that no name server is involved. */
    boolean isLiterally(InetAddress address) {
        String printed = address.getHostAddress();
        int zone = printed.indexOf('%');
        return host.equals(zone < 0 ? printed : printed.substring(0, zone));
    }
}
