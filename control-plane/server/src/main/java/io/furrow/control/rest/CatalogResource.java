package io.furrow.control.rest;

import java.util.Properties;

import jakarta.ws.rs.GET;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.QueryParam;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;

import io.furrow.control.rest.view.KafkaReads;
import io.furrow.kafka.catalog.Catalog;

/** {@code /api/catalog}: the types of each mission with their attributes, as {@code ingest} has counted them. */
@Path("/api/catalog")
@Produces(MediaType.APPLICATION_JSON)
public final class CatalogResource {
    private final Properties client;
    private final KafkaReads reads;

    /** @param client settings of a Kafka client */
    CatalogResource(Properties client, KafkaReads reads) {
        this.client = client;
        this.reads = reads;
    }

    /** @param domain null for all @param mission null for all */
    @GET
    public Response list(@QueryParam("domain") String domain, @QueryParam("mission") String mission) {
        return JsonResponses.ok(
                reads.run(() -> Catalog.read(client)).stream().filter(entry -> Catalog.isOf(entry, domain, mission)));
    }
}
