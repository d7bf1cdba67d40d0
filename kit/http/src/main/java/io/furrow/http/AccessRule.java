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
 * Answers a request only if it names this server, and no page of another origin sent it. Without the first, a page whose name server
 * suddenly points to 127.0.0.1 is taken for the server's own; without the second, any page can command a server on its
 * reader's machine, which browsers let it reach. Credentials are no substitute for either, and what proxies say in
 * {@code X-Forwarded-*} is not believed.
 */
public final class AccessRule {
    private static final Set<String> OTHER_SITES = Set.of("cross-site", "same-site");
    private static final String PREFLIGHT_SECONDS = "600";
    private static final int MAX_NAMES = 64;

    private final Set<String> hosts;
    private final Set<Origin> origins;
    private final Set<String> probes;
    private final OptionNames options;
    /** Nearly all requests come under the same few names: those that were found to be this server's. */
    private final Set<Name> own = ConcurrentHashMap.newKeySet();

    /** A host as a request names it, and the server's end of its connection. */
    private record Name(String host, InetAddress local) {}

    private AccessRule(Set<String> hosts, Set<Origin> origins, Set<String> probes, OptionNames options) {
        this.hosts = hosts;
        this.origins = origins;
        this.probes = probes;
        this.options = options;
    }

    /** Lets in what names loopback or the address that the connection arrived at, and what an operator allows. */
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
     * Lets these in as well.
     *
     * @param names for instance the address that is listened on; null and what is not a host add nothing
     */
    public AccessRule servedAs(String... names) {
        Set<String> more = new HashSet<>(hosts);
        Stream.of(names)
                .filter(name -> name != null)
                .flatMap(name -> Authority.parse(AllowedNames.bracketed(name)).stream())
                .forEach(authority -> more.add(authority.host()));
        return new AccessRule(Set.copyOf(more), origins, probes, options);
    }

    /** Lets in the host of this URL as well, for instance the one that clients are given; what is not a URL adds nothing. */
    public AccessRule servedAt(String url) {
        return HttpCall.authorityOf(url)
                .flatMap(Authority::parse)
                .map(authority -> servedAs(authority.host()))
                .orElse(this);
    }

    /** Lets anybody read these paths under any host: probes come by the address of a pod or by none. */
    public AccessRule withProbes(String... paths) {
        return new AccessRule(hosts, origins, Set.of(paths), options);
    }

    /** Decides before anything of the body is read. */
    public Decision decide(HttpCall call) {
        List<String> named = call.values("Host");
        boolean probe = call.isRead() && probes.contains(call.path());
        if (!probe) {
            Optional<Decision> foreign = refuseHost(call, named);
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
            return share(call, sent.get(0));
        }
        return origin.isPresent() && origin.equals(ownOrigin(call, named))
                ? new Decision.Granted(Map.of())
                : foreignOrigin(origin);
    }

    private Optional<Decision> refuseHost(HttpCall call, List<String> named) {
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

    /** That of a page that this server itself has sent: the browser reached it under the same name. */
    private static Optional<Origin> ownOrigin(HttpCall call, List<String> named) {
        return named.size() == 1
                ? Authority.parse(named.get(0)).map(authority -> Origin.of(call.scheme(), authority))
                : Optional.empty();
    }

    /** Browsers send no origin with images, frames and links; links may be followed. */
    private static boolean isOfAnotherSite(HttpCall call) {
        boolean link = call.isRead()
                && call.header("Sec-Fetch-Mode").filter("navigate"::equals).isPresent()
                && call.header("Sec-Fetch-Dest").filter("document"::equals).isPresent();
        return !link && call.values("Sec-Fetch-Site").stream().anyMatch(OTHER_SITES::contains);
    }

    /** Without these headers a browser would send what the page asks, and keep the answer from it. */
    private static Decision share(HttpCall call, String origin) {
        Map<String, String> headers = new HashMap<>(Map.of("Access-Control-Allow-Origin", origin, "Vary", "Origin"));
        if (!call.isPreflight()) {
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
