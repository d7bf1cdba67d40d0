package io.furrow.control.rest.access;

import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.ContainerRequestFilter;
import jakarta.ws.rs.container.PreMatching;
import jakarta.ws.rs.core.UriInfo;

/** Answers {@code /api/v1/…} as {@code /api/…}. */
@PreMatching
public final class VersionFilter implements ContainerRequestFilter {
    private static final String VERSION = "api/v1/";

    @Override
    public void filter(ContainerRequestContext request) {
        UriInfo uri = request.getUriInfo();
        String path = uri.getPath(false);
        if (path.startsWith(VERSION)) {
            request.setRequestUri(uri.getRequestUriBuilder()
                    .replacePath("/api/" + path.substring(VERSION.length()))
                    .build());
        }
    }
}
