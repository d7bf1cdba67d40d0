package io.furrow.http;

import java.util.List;
import java.util.function.Consumer;

/**
 * Hosts and origins that an operator allows in addition to a server's own.
 *
 * @param hosts names or addresses without scheme and port, for instance {@code farm.example.org}
 * @param origins {@code scheme://host} or {@code scheme://host:port}, for instance {@code https://map.example.org}
 */
public record AllowedNames(List<String> hosts, List<String> origins) {
    public static final AllowedNames NONE = new AllowedNames(List.of(), List.of());

    /** @throws IllegalArgumentException if an entry is invalid; the message says why */
    public AllowedNames {
        hosts = List.copyOf(hosts);
        origins = List.copyOf(origins);
        hosts.forEach(AllowedNames::requireHost);
        origins.forEach(AllowedNames::requireOrigin);
    }

    /** @throws IllegalArgumentException if an entry is invalid; the message names the option */
    public static AllowedNames of(OptionNames options, List<String> hosts, List<String> origins) {
        requireEach(options.hosts(), hosts, AllowedNames::requireHost);
        requireEach(options.origins(), origins, AllowedNames::requireOrigin);
        return new AllowedNames(hosts, origins);
    }

    private static void requireEach(String option, List<String> values, Consumer<String> check) {
        try {
            values.forEach(check);
        } catch (IllegalArgumentException e) {
            throw new IllegalArgumentException(option + ": " + e.getMessage(), e);
        }
    }

    /** @throws IllegalArgumentException if it is not a host, or one with a port */
    public static void requireHost(String host) {
        if (Authority.parse(bracketed(host))
                .filter(authority -> authority.port() == Authority.NO_PORT && !host.endsWith(":"))
                .isEmpty()) {
            throw new IllegalArgumentException(
                    "'%s' is not a host: expected a name or an address without scheme and port, such as farm.example.org"
                            .formatted(host));
        }
    }

    /** @throws IllegalArgumentException if it is not an origin */
    public static void requireOrigin(String origin) {
        if (Origin.parse(origin).isEmpty()) {
            throw new IllegalArgumentException(
                    "'%s' is not an origin: expected scheme://host or scheme://host:port without a path, such as https://map.example.org"
                            .formatted(origin));
        }
    }

    /** Adds brackets to an IPv6 address without them. */
    static String bracketed(String host) {
        return host.indexOf(':') < 0 || host.startsWith("[") ? host : "[" + host + "]";
    }
}
