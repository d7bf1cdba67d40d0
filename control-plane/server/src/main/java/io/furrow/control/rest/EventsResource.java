package io.furrow.control.rest;

import java.util.Map;

import jakarta.ws.rs.GET;
import jakarta.ws.rs.HEAD;
import jakarta.ws.rs.HeaderParam;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.PathParam;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.container.AsyncResponse;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.Suspended;
import jakarta.ws.rs.core.Context;
import jakarta.ws.rs.core.HttpHeaders;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;

import io.furrow.control.rest.description.ApiDescription;
import io.furrow.control.rest.view.ResourceFeeds;
import io.furrow.control.rest.view.ResourceKind;
import io.furrow.control.rest.view.StateView;

/** {@code /api/events}: changes of all resources of a kind as server-sent events. */
@Path("/api/events/{kind: missions|devices|alarms|replays}")
@Produces({MediaType.SERVER_SENT_EVENTS, MediaType.APPLICATION_JSON})
public final class EventsResource {
    private static final Map<String, String> SCHEMAS =
            Map.of("missions", "Mission", "devices", "Device", "alarms", "Alarm", "replays", "Replay");

    private final ResourceFeeds feeds;
    private final ApiDescription description;
    private final Map<String, ResourceKind> kinds;

    EventsResource(StateView view, ResourceFeeds feeds, ApiDescription description) {
        this.feeds = feeds;
        this.description = description;
        this.kinds = Map.of(
                "missions", ResourceKind.missions(view),
                "devices", ResourceKind.devices(view),
                "alarms", ResourceKind.alarms(view),
                "replays", ResourceKind.replays(view));
    }

    /** Tells whether the caller may follow them, without opening a stream. */
    @HEAD
    public Response probe() {
        return Response.ok().type(MediaType.SERVER_SENT_EVENTS).build();
    }

    /** Streams their changes. @param since id of the last event that the client has received; null for none */
    @GET
    public void follow(
            @Context ContainerRequestContext request,
            @PathParam("kind") String kind,
            @HeaderParam(HttpHeaders.LAST_EVENT_ID_HEADER) String since,
            @Suspended AsyncResponse response) {
        feeds.open(kinds.get(kind).mapped(description.times(request, SCHEMAS.get(kind))), null, since, response);
    }
}
