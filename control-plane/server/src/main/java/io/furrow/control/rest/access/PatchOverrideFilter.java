package io.furrow.control.rest.access;

import jakarta.ws.rs.HttpMethod;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.ContainerRequestFilter;
import jakarta.ws.rs.container.PreMatching;

/** Takes a POST with {@code X-HTTP-Method-Override: PATCH} for a PATCH, which some clients and proxies cannot send. */
@PreMatching
public final class PatchOverrideFilter implements ContainerRequestFilter {
    static final String HEADER = "X-HTTP-Method-Override";

    @Override
    public void filter(ContainerRequestContext request) {
        String method = request.getHeaderString(HEADER);
        if (method == null) {
            return;
        }
        if (!method.equals(HttpMethod.PATCH) || !request.getMethod().equals(HttpMethod.POST)) {
            throw new ProblemException(400, "wrong-header", HEADER + " may only make a POST a PATCH");
        }
        request.setMethod(method);
    }
}
