package io.furrow.http.connect;

import java.net.InetAddress;
import java.net.UnknownHostException;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

import jakarta.annotation.Priority;
import jakarta.servlet.http.HttpServletRequest;
import jakarta.ws.rs.Priorities;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.ContainerRequestFilter;
import jakarta.ws.rs.container.ContainerResponseContext;
import jakarta.ws.rs.container.ContainerResponseFilter;
import jakarta.ws.rs.container.PreMatching;
import jakarta.ws.rs.core.Context;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;

import io.furrow.http.AccessRule;
import io.furrow.http.Decision;
import io.furrow.http.HttpCall;

/**
 * Applies the rule and rejects requests in the format of Connect's own errors. A separate class because {@link
 * AccessExtension} must load without JAX-RS, too.
 */
@PreMatching
@Priority(Priorities.AUTHENTICATION - 1)
final class AccessFilter implements ContainerRequestFilter, ContainerResponseFilter {
    private static final String GRANTED = AccessFilter.class.getName();

    private final AccessRule rule;

    @Context
    private HttpServletRequest servlet;

    AccessFilter(AccessRule rule) {
        this.rule = rule;
    }

    @Override
    public void filter(ContainerRequestContext request) {
        Decision decision = rule.decide(call(request));
        if (decision instanceof Decision.Granted granted) {
            request.setProperty(GRANTED, granted);
        } else if (decision instanceof Decision.Preflight preflight) {
            Response.ResponseBuilder answer = Response.noContent();
            preflight.headers().forEach(answer::header);
            request.abortWith(answer.build());
        } else if (decision instanceof Decision.Refused refused) {
            request.abortWith(Response.status(Decision.REFUSED_STATUS)
                    .type(MediaType.APPLICATION_JSON_TYPE)
                    .entity(new TreeMap<>(Map.of("error_code", Decision.REFUSED_STATUS, "message", refused.reason())))
                    .build());
        }
    }

    @Override
    public void filter(ContainerRequestContext request, ContainerResponseContext response) {
        if (request.getProperty(GRANTED) instanceof Decision.Granted granted) {
            granted.headers().forEach(response.getHeaders()::putSingle);
        }
    }

    private HttpCall call(ContainerRequestContext request) {
        return new HttpCall(
                request.getMethod(),
                request.getUriInfo().getRequestUri().toString(),
                servlet.isSecure(),
                local(),
                header -> request.getHeaders().getOrDefault(header, List.of()));
    }

    private InetAddress local() {
        try {
            return InetAddress.getByName(servlet.getLocalAddr());
        } catch (UnknownHostException e) { // impossible for an address that Jetty printed
            return null;
        }
    }
}
