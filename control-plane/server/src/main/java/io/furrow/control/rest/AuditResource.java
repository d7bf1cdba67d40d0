package io.furrow.control.rest;

import java.util.ArrayList;
import java.util.List;
import java.util.Properties;
import java.util.function.Predicate;

import com.fasterxml.jackson.databind.node.ArrayNode;
import jakarta.ws.rs.DefaultValue;
import jakarta.ws.rs.GET;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.QueryParam;
import jakarta.ws.rs.core.Context;
import jakarta.ws.rs.core.Link;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;
import jakarta.ws.rs.core.UriInfo;

import io.furrow.control.rest.view.AuditHistory;
import io.furrow.control.rest.view.AuditedEntry;
import io.furrow.control.rest.view.StateView;
import io.furrow.model.ngsi.NgsiJson;

/** {@code /api/audit}: reads the newest entries from memory, older ones from Kafka. */
@Path("/api/audit")
@Produces(MediaType.APPLICATION_JSON)
public final class AuditResource {
    private final StateView view;
    private final AuditHistory history;

    /** @param client settings of a Kafka client */
    AuditResource(StateView view, Properties client) {
        this.view = view;
        this.history = new AuditHistory(client);
    }

    /**
     * Lists entries, the newest first. If there may be older ones, a {@code Link} with {@code rel="next"} refers to
     * them.
     *
     * @param limit 1 to {@value StateView#AUDITED}
     * @param before exclusive upper bound of positions; null for the newest
     * @param device selects commands about it; null for all
     * @param mission selects commands about it; null for all
     */
    @GET
    public Response list(
            @Context UriInfo uri,
            @QueryParam("limit") @DefaultValue("100") int limit,
            @QueryParam("before") Long before,
            @QueryParam("device") String device,
            @QueryParam("mission") String mission) {
        Predicate<AuditedEntry> desired = entry -> entry.isAbout("device", device) && entry.isAbout("mission", mission);
        AuditHistory.Page page = page(before == null ? Long.MAX_VALUE : before, limit, desired);
        ArrayNode entries = NgsiJson.array();
        page.entries().forEach(each -> entries.add(each.json()));
        Response.ResponseBuilder answer = JsonResponses.json(200, entries);
        if (page.next() >= 0) {
            answer.header("Link", next(uri, page.next()));
        }
        return answer.build();
    }

    private AuditHistory.Page page(long before, int limit, Predicate<AuditedEntry> desired) {
        StateView.AuditPage cached = view.audited(before);
        if (cached.entries().isEmpty() && !cached.isWhole()) {
            return history.read(before, limit, desired);
        }
        List<AuditedEntry> found = new ArrayList<>();
        long next = -1;
        for (AuditedEntry entry : cached.entries()) {
            if (found.size() == limit) {
                return new AuditHistory.Page(found, next);
            }
            next = entry.position();
            if (desired.test(entry)) {
                found.add(entry);
            }
        }
        return new AuditHistory.Page(found, cached.isWhole() ? -1 : next);
    }

    /** Returns a link relative to the request, because of proxies. */
    static Link next(UriInfo uri, Object before) {
        String query = uri.getRequestUriBuilder()
                .replaceQueryParam("before", before)
                .build()
                .getRawQuery();
        return Link.fromUri("?" + query).rel("next").build();
    }
}
