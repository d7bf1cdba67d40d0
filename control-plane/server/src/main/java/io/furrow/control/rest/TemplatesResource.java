package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.util.Comparator;
import java.util.Optional;
import java.util.concurrent.CompletionStage;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.annotation.security.RolesAllowed;
import jakarta.ws.rs.Consumes;
import jakarta.ws.rs.DELETE;
import jakarta.ws.rs.GET;
import jakarta.ws.rs.POST;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.PathParam;
import jakarta.ws.rs.Produces;
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

/** {@code /api/templates}; a returned template can be saved again. */
@Path("/api/templates")
@Consumes(MediaType.APPLICATION_JSON)
@Produces(MediaType.APPLICATION_JSON)
public final class TemplatesResource {
    private static final String TEMPLATE = "template";
    private static final String VERSION = "version";
    private static final Pattern NAME = Pattern.compile("([^@]+)(?:@([1-9][0-9]{0,8}))?");

    private final StateView view;
    private final Manager manager;

    TemplatesResource(StateView view, CommandClient managers) {
        this.view = view;
        this.manager = new Manager(managers, Topics.MISSION_MANAGER);
    }

    @GET
    public Response list() {
        return JsonResponses.ok(view.all(Topics.TEMPLATES));
    }

    /** Saves a template as its next version. */
    @POST
    public CompletionStage<Response> save(@Context ContainerRequestContext request, InputStream body)
            throws IOException {
        return manager.request(request, "save-template", JsonBodyReader.read(body))
                .thenApply(answer -> JsonResponses.created(request, answer, "templates", TEMPLATE));
    }

    /** @param name {@code <name>} for the newest, or {@code <name>@<version>} */
    @GET
    @Path("{template}")
    public Response get(@PathParam(TEMPLATE) String name) {
        Optional<ObjectNode> template = name.contains("@")
                ? view.find(Topics.TEMPLATES, name)
                : view.all(Topics.TEMPLATES)
                        .filter(each -> name.equals(each.path(TEMPLATE).textValue()))
                        .max(Comparator.comparingInt(each -> each.path(VERSION).asInt()));
        return JsonResponses.ok(template.orElseThrow(() -> unknown(name)));
    }

    /** @param name {@code <name>} for all versions, or {@code <name>@<version>} */
    @RolesAllowed(Role.ADMINS)
    @DELETE
    @Path("{template}")
    public CompletionStage<Response> delete(
            @Context ContainerRequestContext request, @PathParam(TEMPLATE) String name) {
        Matcher parts = NAME.matcher(name);
        if (!parts.matches()) {
            throw unknown(name);
        }
        ObjectNode members = NgsiJson.object().put(TEMPLATE, parts.group(1));
        if (parts.group(2) != null) {
            members.put(VERSION, Integer.parseInt(parts.group(2)));
        }
        return manager.command(request, "delete-template", members);
    }

    private static ProblemException unknown(String name) {
        return new ProblemException(ErrorCode.UNKNOWN_TEMPLATE, "there is no template '%s'".formatted(name));
    }
}
