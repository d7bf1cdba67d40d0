package io.furrow.control.rest;

import jakarta.ws.rs.GET;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.core.Context;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;

import io.furrow.control.rest.access.ApiToken;
import io.furrow.control.rest.access.RequestContext;
import io.furrow.control.rest.access.TokenFilter;
import io.furrow.model.control.Role;
import io.furrow.model.ngsi.NgsiJson;

/** {@code /api/me}. */
@Path("/api/me")
@Produces(MediaType.APPLICATION_JSON)
public final class CallerResource {
    /** Returns the caller's name, as used on the audit topic, and role. Without tokens every caller is an admin. */
    @GET
    public Response me(@Context ContainerRequestContext request) {
        Role role = request.getProperty(TokenFilter.TOKEN) instanceof ApiToken token ? token.role() : Role.ADMIN;
        return JsonResponses.ok(
                NgsiJson.object().put("user", RequestContext.user(request)).put("role", role.code()));
    }
}
