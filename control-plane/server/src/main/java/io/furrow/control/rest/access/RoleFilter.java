package io.furrow.control.rest.access;

import java.lang.reflect.Method;
import java.util.Set;

import jakarta.annotation.Priority;
import jakarta.annotation.security.RolesAllowed;
import jakarta.ws.rs.Priorities;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.ContainerRequestFilter;
import jakarta.ws.rs.container.ResourceInfo;
import jakarta.ws.rs.core.Context;

import io.furrow.model.control.Role;

/**
 * Refuses what the role of a caller does not allow. A viewer may read, an operator may do everything else too, but for operations
 * with {@link RolesAllowed}. Where no tokens are asked for, a caller is an admin.
 */
@Priority(Priorities.AUTHORIZATION)
public final class RoleFilter implements ContainerRequestFilter {
    private static final Set<String> READING = Set.of("GET", "HEAD", "OPTIONS");

    @Context
    private ResourceInfo operation;

    @Override
    public void filter(ContainerRequestContext request) {
        if (!(request.getProperty(TokenFilter.TOKEN) instanceof ApiToken token)) {
            return;
        }
        Role minimum = minimum(operation.getResourceMethod(), request.getMethod());
        if (!token.role().includes(minimum)) {
            throw new ProblemException(
                    403,
                    "forbidden",
                    "this needs the role %s, and '%s' is %s"
                            .formatted(
                                    minimum.code(), token.name(), token.role().code()));
        }
    }

    /** The role that an operation needs at least. */
    public static Role minimum(Method operation, String httpMethod) {
        RolesAllowed named = operation == null ? null : operation.getAnnotation(RolesAllowed.class);
        if (named != null) {
            return Role.of(named.value()[0]).orElseThrow();
        }
        return READING.contains(httpMethod) ? Role.VIEWER : Role.OPERATOR;
    }
}
