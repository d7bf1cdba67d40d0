package io.furrow.control.rest;

import java.util.Locale;
import java.util.Set;

import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.ContainerRequestFilter;
import jakarta.ws.rs.container.PreMatching;

/**
 * Refuses what pages of other hosts make a browser send: without it any page could command a farm on the same machine. Where no token
 * is asked for, names that a page's owner could let point here are refused as well.
 */
@PreMatching
final class OwnPagesOnly implements ContainerRequestFilter {
    private static final Set<String> LOOPBACK = Set.of("localhost", "127.0.0.1", "[::1]");

    private final String host;
    private final boolean anyName;

    /** @param host on which it listens @param anyName whether it may be reached by any name */
    OwnPagesOnly(String host, boolean anyName) {
        this.host = host;
        this.anyName = anyName;
    }

    @Override
    public void filter(ContainerRequestContext request) {
        String name = request.getUriInfo().getBaseUri().getHost();
        boolean ownName = anyName
                || host.equals(name)
                || LOOPBACK.contains(String.valueOf(name).toLowerCase(Locale.ROOT));
        String origin = request.getHeaderString("Origin");
        boolean ownPage = origin == null
                || origin.endsWith("://" + request.getUriInfo().getBaseUri().getAuthority());
        if (!ownName) {
            request.abortWith(Replies.problem(new ProblemException(
                    403, "foreign-host", "without tokens this API is reached as localhost or 127.0.0.1 only")));
        } else if (!ownPage) {
            request.abortWith(Replies.problem(
                    new ProblemException(403, "foreign-origin", "pages of other hosts may not use this API")));
        }
    }
}
