package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.util.function.Supplier;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import jakarta.ws.rs.GET;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;

/** What tells of the API itself, without a token: its description, whether it is ready, its numbers. */
@Path("/")
public final class ServicePages {
    private final ServiceView view;
    private final Supplier<String> managers;
    private final RestMetrics metrics;
    private final byte[] description;

    /** @param managers the state of the managers in this process */
    ServicePages(ServiceView view, Supplier<String> managers, RestMetrics metrics) throws IOException {
        this.view = view;
        this.managers = managers;
        this.metrics = metrics;
        try (InputStream json = ServicePages.class.getResourceAsStream("openapi.json")) {
            this.description = json.readAllBytes();
        }
    }

    @GET
    @Path("openapi.json")
    @Produces(MediaType.APPLICATION_JSON)
    public Response description() {
        return Response.ok(description).build();
    }

    /** 200 where requests are answered, else 503. */
    @GET
    @Path("health")
    @Produces(MediaType.APPLICATION_JSON)
    public Response health() {
        boolean ready = view.isComplete() && "RUNNING".equals(managers.get());
        Response.ResponseBuilder answer = Replies.json(
                ready ? 200 : 503,
                JsonNodeFactory.instance
                        .objectNode()
                        .put("status", ready ? "up" : "starting")
                        .put("view", view.isComplete() ? "complete" : "incomplete")
                        .put("managers", managers.get()));
        return (ready ? answer : answer.header("Retry-After", 1)).build();
    }

    @GET
    @Path("metrics")
    @Produces(MediaType.TEXT_PLAIN)
    public Response metrics() {
        return Response.ok(metrics.page(), RestMetrics.CONTENT_TYPE).build();
    }
}
