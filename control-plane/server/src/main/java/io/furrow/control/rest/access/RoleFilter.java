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
 * Rejects requests that the role of the caller does not allow. A viewer may read, an operator may do everything else
 * except operations with {@link RolesAllowed}. Without tokens every caller is an admin.
 */
@Priority(Priorities.AUTHORIZATION)
public final class RoleFilter implements ContainerRequestFilter {
    private static final Set<String> READ_METHODS = Set.of("GET", "HEAD", "OPTIONS");

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

    /** Returns the minimum role for an operation. */
    public static Role minimum(Method operation, String httpMethod) {
        RolesAllowed roles = operation == null ? null : operation.getAnnotation(RolesAllowed.class);
        if (roles != null) {
            return Role.of(roles.value()[0]).orElseThrow();
        }
        return READ_METHODS.contains(httpMethod) ? Role.VIEWER : Role.OPERATOR;
    }
}
