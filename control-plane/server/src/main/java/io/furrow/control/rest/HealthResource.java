package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;

import com.fasterxml.jackson.databind.node.ObjectNode;
import com.fasterxml.jackson.dataformat.yaml.YAMLMapper;
import jakarta.ws.rs.GET;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;

import io.furrow.http.prometheus.MetricsPage;
import io.furrow.kafka.Readiness;
import io.furrow.model.ngsi.NgsiJson;

/** What reports the API itself, without a token: its description, whether it is ready, its numbers. */
@Path("/")
public final class HealthResource {
    private final Readiness readiness;
    private final RestMetrics metrics;
    private final byte[] description;

    HealthResource(Readiness readiness, RestMetrics metrics) throws IOException {
        this.readiness = readiness;
        this.metrics = metrics;
        try (InputStream yaml = HealthResource.class.getResourceAsStream("openapi.yaml")) {
            this.description = NgsiJson.mapper().writeValueAsBytes(new YAMLMapper().readTree(yaml));
        }
    }

    @GET
    @Path("openapi.json")
    @Produces(MediaType.APPLICATION_JSON)
    public Response description() {
        return Response.ok(description).build();
    }

    /** 200 unless a part has ended that only a restart brings back; the same as on the port for probes. */
    @GET
    @Path("health")
    @Produces(MediaType.APPLICATION_JSON)
    public Response health() {
        return page(readiness.isAlive(), readiness.health());
    }

    /** 200 where requests are answered, else 503; the same as on the port for probes. */
    @GET
    @Path("ready")
    @Produces(MediaType.APPLICATION_JSON)
    public Response ready() {
        return page(readiness.isReady(), readiness.readiness());
    }

    private static Response page(boolean good, ObjectNode page) {
        Response.ResponseBuilder answer =
                JsonResponses.json(good ? 200 : 503, page).header("Cache-Control", "no-store");
        return (good ? answer : answer.header("Retry-After", 1)).build();
    }

    @GET
    @Path("metrics")
    @Produces(MediaType.TEXT_PLAIN)
    public Response metrics() {
        return Response.ok(metrics.page(), MetricsPage.CONTENT_TYPE).build();
    }
}
