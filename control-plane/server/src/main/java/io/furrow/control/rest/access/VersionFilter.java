package io.furrow.control.rest.access;

import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.ContainerRequestFilter;
import jakarta.ws.rs.container.PreMatching;
import jakarta.ws.rs.core.UriInfo;

/** Answers {@code /api/v1/…} as {@code /api/…}, and marks such requests. */
@PreMatching
public final class VersionFilter implements ContainerRequestFilter {
    public static final String VERSION = "api/v1/";

    private static final String VERSIONED = VersionFilter.class.getName();

    /** Whether a request names the version. */
    public static boolean isVersioned(ContainerRequestContext request) {
        return request.getProperty(VERSIONED) != null;
    }

    @Override
    public void filter(ContainerRequestContext request) {
        UriInfo uri = request.getUriInfo();
        String path = uri.getPath(false);
        if (path.startsWith(VERSION)) {
            request.setProperty(VERSIONED, true);
            request.setRequestUri(uri.getRequestUriBuilder()
                    .replacePath("/api/" + path.substring(VERSION.length()))
                    .build());
        }
    }
}
