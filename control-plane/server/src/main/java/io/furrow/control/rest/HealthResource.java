package io.furrow.control.rest;

import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.ws.rs.GET;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;

import io.furrow.control.rest.description.ApiDescription;
import io.furrow.http.prometheus.MetricsPage;
import io.furrow.kafka.Readiness;

/** Serves the description, health, readiness and metrics of the API, without a token. */
@Path("/")
public final class HealthResource {
    private final Readiness readiness;
    private final RestMetrics metrics;
    private final byte[] description;

    HealthResource(Readiness readiness, RestMetrics metrics, ApiDescription description) {
        this.readiness = readiness;
        this.metrics = metrics;
        this.description = description.toBytes();
    }

    @GET
    @Path("openapi.json")
    @Produces(MediaType.APPLICATION_JSON)
    public Response description() {
        return Response.ok(description).build();
    }

    /** 200 unless a part has ended that only a restart recovers; the same as on the port for probes. */
    @GET
    @Path("health")
    @Produces(MediaType.APPLICATION_JSON)
    public Response health() {
        return page(readiness.isAlive(), readiness.health());
    }

    /** 200 if requests are answered, else 503; the same as on the port for probes. */
    @GET
    @Path("ready")
    @Produces(MediaType.APPLICATION_JSON)
    public Response ready() {
        return page(readiness.isReady(), readiness.readiness());
    }

    private static Response page(boolean ok, ObjectNode page) {
        Response.ResponseBuilder answer =
                JsonResponses.json(ok ? 200 : 503, page).header("Cache-Control", "no-store");
        return (ok ? answer : answer.header("Retry-After", 1)).build();
    }

    @GET
    @Path("metrics")
    @Produces(MediaType.TEXT_PLAIN)
    public Response metrics() {
        return Response.ok(metrics.page(), MetricsPage.CONTENT_TYPE).build();
    }
}
