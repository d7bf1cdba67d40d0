package io.furrow.control.rest;

import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.ContainerRequestFilter;
import jakarta.ws.rs.container.PreMatching;

/** Refuses what pages of other hosts make a browser send: without it any page could command a farm on the same machine. */
@PreMatching
final class OwnPagesOnly implements ContainerRequestFilter {
    @Override
    public void filter(ContainerRequestContext request) {
        String origin = request.getHeaderString("Origin");
        String own = request.getUriInfo().getBaseUri().getAuthority();
        if (origin != null && !origin.endsWith("://" + own)) {
            request.abortWith(Replies.problem(
                    new ProblemException(403, "foreign-origin", "pages of other hosts may not use this API")));
        }
    }
}
