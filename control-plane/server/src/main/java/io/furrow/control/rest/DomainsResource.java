package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.util.concurrent.CompletionStage;

import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.annotation.security.RolesAllowed;
import jakarta.ws.rs.Consumes;
import jakarta.ws.rs.DELETE;
import jakarta.ws.rs.GET;
import jakarta.ws.rs.PATCH;
import jakarta.ws.rs.POST;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.PathParam;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.QueryParam;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.core.Context;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.control.rest.view.CommandClient;
import io.furrow.control.rest.view.StateView;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Role;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

/** {@code /api/domains}. */
@Path("/api/domains")
@Consumes(MediaType.APPLICATION_JSON)
@Produces(MediaType.APPLICATION_JSON)
public final class DomainsResource {
    private static final String DOMAIN = "domain";

    private final StateView view;
    private final Manager manager;

    DomainsResource(StateView view, CommandClient managers) {
        this.view = view;
        this.manager = new Manager(managers, Topics.DOMAIN_MANAGER);
    }

    @GET
    public Response list() {
        return JsonResponses.ok(view.all(Topics.DOMAINS));
    }

    @POST
    public CompletionStage<Response> create(@Context ContainerRequestContext request, InputStream body)
            throws IOException {
        return manager.request(request, "create", JsonBodyReader.read(body))
                .thenApply(answer -> JsonResponses.created(request, answer, "domains", DOMAIN));
    }

    @GET
    @Path("{domain}")
    public Response get(@PathParam(DOMAIN) String domain) {
        return JsonResponses.one(view.find(Topics.DOMAINS, domain)
                .orElseThrow(() ->
                        new ProblemException(ErrorCode.UNKNOWN_DOMAIN, "there is no domain '%s'".formatted(domain))));
    }

    /** Merges the body into a domain, as RFC 7396 defines it. */
    @PATCH
    @Path("{domain}")
    @Consumes({JsonBodyReader.MERGE_PATCH, MediaType.APPLICATION_JSON})
    public CompletionStage<Response> change(
            @Context ContainerRequestContext request, @PathParam(DOMAIN) String domain, InputStream body)
            throws IOException {
        return manager.command(request, "patch", JsonBodyReader.read(body).put(DOMAIN, domain));
    }

    /** @param force whether to stop missions that run in it */
    @RolesAllowed(Role.ADMINS)
    @DELETE
    @Path("{domain}")
    public CompletionStage<Response> delete(
            @Context ContainerRequestContext request,
            @PathParam(DOMAIN) String domain,
            @QueryParam("force") boolean force) {
        ObjectNode members = NgsiJson.object();
        return manager.command(request, "delete", members.put(DOMAIN, domain).put("force", force));
    }
}
