package io.furrow.http;

import java.net.InetAddress;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * Grants a request only if it names this server and was not sent by a page of another origin. The host check stops DNS
 * rebinding: a page whose name suddenly resolves to 127.0.0.1 would otherwise count as the server's own. The origin
 * check stops requests of other pages, which browsers allow to reach servers on the user's machine. Neither is a
 * substitute for credentials, nor credentials for these. The rule ignores {@code X-Forwarded-*}.
 */
public final class AccessRule {
    private static final Set<String> OTHER_SITES = Set.of("cross-site", "same-site");
    private static final String PREFLIGHT_SECONDS = "600";
    /** Headers of answers that pages of other origins may read. */
    private static final String EXPOSED = "ETag, Link, Location, Retry-After";

    private static final int MAX_NAMES = 64;

    private final Set<String> hosts;
    private final Set<Origin> origins;
    private final Set<String> probes;
    private final OptionNames options;
    /** Cache of names that are this server's; nearly all requests use the same few. */
    private final Set<Name> own = ConcurrentHashMap.newKeySet();

    /** The host that a request names, and the server's address of its connection. */
    private record Name(String host, InetAddress local) {}

    private AccessRule(Set<String> hosts, Set<Origin> origins, Set<String> probes, OptionNames options) {
        this.hosts = hosts;
        this.origins = origins;
        this.probes = probes;
        this.options = options;
    }

    /** Creates a rule that allows loopback, the address of the connection, and the operator's names. */
    public static AccessRule allowing(AllowedNames allowed, OptionNames options) {
        return new AccessRule(
                        Set.of(),
                        allowed.origins().stream()
                                .map(origin -> Origin.parse(origin).orElseThrow())
                                .collect(Collectors.toUnmodifiableSet()),
                        Set.of(),
                        options)
                .servedAs(allowed.hosts().toArray(String[]::new));
    }

    /**
     * Allows further hosts.
     *
     * @param names for instance the listen address; null and invalid hosts are ignored
     */
    public AccessRule servedAs(String... names) {
        Set<String> more = new HashSet<>(hosts);
        Stream.of(names)
                .filter(name -> name != null)
                .flatMap(name -> Authority.parse(AllowedNames.bracketed(name)).stream())
                .forEach(authority -> more.add(authority.host()));
        return new AccessRule(Set.copyOf(more), origins, probes, options);
    }

    /** Allows the host of this URL, for instance the one that clients are given; an invalid URL is ignored. */
    public AccessRule servedAt(String url) {
        return HttpCall.authorityOf(url)
                .flatMap(Authority::parse)
                .map(authority -> servedAs(authority.host()))
                .orElse(this);
    }

    /** Allows reads of these paths under any host, because probes use a pod's address or no host. */
    public AccessRule withProbes(String... paths) {
        return new AccessRule(hosts, origins, Set.of(paths), options);
    }

    /** Decides on a request before its body is read. */
    public Decision decide(HttpCall call) {
        List<String> named = call.values("Host");
        boolean probe = call.isRead() && probes.contains(call.path());
        if (!probe) {
            Optional<Decision> foreign = checkHost(call, named);
            if (foreign.isPresent()) {
                return foreign.get();
            }
        }
        List<String> sent = call.values("Origin");
        if (sent.isEmpty()) {
            return isOfAnotherSite(call) ? foreignSite() : new Decision.Granted(Map.of());
        }
        Optional<Origin> origin = sent.size() == 1 ? Origin.parse(sent.get(0)) : Optional.empty();
        if (origin.filter(origins::contains).isPresent()) {
            return withCorsHeaders(call, sent.get(0));
        }
        return origin.isPresent() && origin.equals(ownOrigin(call, named))
                ? new Decision.Granted(Map.of())
                : foreignOrigin(origin);
    }

    private Optional<Decision> checkHost(HttpCall call, List<String> named) {
        if (named.size() != 1) {
            return Optional.of(new Decision.Refused(
                    "foreign-host", "a request names its host in one Host header; this one has " + named.size()));
        }
        if (!isOwn(new Name(named.get(0), call.local()))) {
            return Optional.of(foreignHost(named.get(0)));
        }
        return HttpCall.authorityOf(call.target())
                .filter(host -> !isOwn(new Name(host, call.local())))
                .map(this::foreignHost);
    }

    private boolean isOwn(Name name) {
        if (own.contains(name)) {
            return true;
        }
        boolean isOwn = Authority.parse(name.host())
                .filter(authority -> authority.isLoopback()
                        || hosts.contains(authority.host())
                        || name.local() != null && authority.isLiterally(name.local()))
                .isPresent();
        if (isOwn && own.size() < MAX_NAMES) {
            own.add(name);
        }
        return isOwn;
    }

    /** Returns the origin of this server's own pages, as the browser reached it. */
    private static Optional<Origin> ownOrigin(HttpCall call, List<String> named) {
        return named.size() == 1
                ? Authority.parse(named.get(0)).map(authority -> Origin.of(call.scheme(), authority))
                : Optional.empty();
    }

    /**
     * Returns whether a page of another site sent the request without an origin, as browsers do for images, frames and
     * links. Links are allowed.
     */
    private static boolean isOfAnotherSite(HttpCall call) {
        boolean link = call.isRead()
                && call.header("Sec-Fetch-Mode").filter("navigate"::equals).isPresent()
                && call.header("Sec-Fetch-Dest").filter("document"::equals).isPresent();
        return !link && call.values("Sec-Fetch-Site").stream().anyMatch(OTHER_SITES::contains);
    }

    /** Grants the request with CORS headers; without them the browser hides the answer from the page. */
    private static Decision withCorsHeaders(HttpCall call, String origin) {
        Map<String, String> headers = new HashMap<>(Map.of("Access-Control-Allow-Origin", origin, "Vary", "Origin"));
        if (!call.isPreflight()) {
            headers.put("Access-Control-Expose-Headers", EXPOSED);
            return new Decision.Granted(Map.copyOf(headers));
        }
        call.header("Access-Control-Request-Method")
                .ifPresent(method -> headers.put("Access-Control-Allow-Methods", method));
        call.header("Access-Control-Request-Headers")
                .ifPresent(names -> headers.put("Access-Control-Allow-Headers", names));
        headers.put("Access-Control-Max-Age", PREFLIGHT_SECONDS);
        return new Decision.Preflight(Map.copyOf(headers));
    }

    private Decision foreignHost(String host) {
        return new Decision.Refused(
                "foreign-host",
                Authority.parse(host)
                        .map(authority -> "this server is not known as '%s'; if it is, name that in %s"
                                .formatted(authority.host(), options.hosts()))
                        .orElse("the request names no host that could be read"));
    }

    private Decision foreignOrigin(Optional<Origin> origin) {
        return new Decision.Refused(
                "foreign-origin",
                origin.map(page -> "pages of %s may not use this server; if they may, name that in %s"
                                .formatted(page, options.origins()))
                        .orElse("pages without an origin of their own may not use this server"));
    }

    private Decision foreignSite() {
        return new Decision.Refused(
                "foreign-origin",
                "a page of another site sent this without its origin; if it may use this server, name its origin in %s and let it send that (crossorigin, fetch)"
                        .formatted(options.origins()));
    }
}
