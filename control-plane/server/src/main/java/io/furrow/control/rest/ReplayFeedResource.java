package io.furrow.control.rest;

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
import io.furrow.control.rest.view.ReplayStatusView;
import io.furrow.control.rest.view.ResourceFeeds;
import io.furrow.control.rest.view.ResourceKind;

/** {@code /api/replays/events}: changes of replays as server-sent events. */
@Path("/api/replays")
@Produces({MediaType.SERVER_SENT_EVENTS, MediaType.APPLICATION_JSON})
public final class ReplayFeedResource {
    private final ReplayStatusView replays;
    private final ResourceKind kind;
    private final ResourceFeeds feeds;
    private final ApiDescription description;

    ReplayFeedResource(ReplayStatusView replays, ResourceFeeds feeds, ApiDescription description) {
        this.replays = replays;
        this.kind = ResourceKind.replays(replays.view());
        this.feeds = feeds;
        this.description = description;
    }

    /** Tells whether the caller may follow all replays, without opening a stream. */
    @HEAD
    @Path("events")
    public Response probeAll() {
        return Response.ok().type(MediaType.SERVER_SENT_EVENTS).build();
    }

    /** Tells whether the caller may follow a replay. */
    @HEAD
    @Path("{replay}/events")
    public Response probeOne() {
        return probeAll();
    }

    /** Streams the changes of all replays. */
    @GET
    @Path("events")
    public void all(
            @Context ContainerRequestContext request,
            @HeaderParam(HttpHeaders.LAST_EVENT_ID_HEADER) String since,
            @Suspended AsyncResponse response) {
        feeds.open(kind.mapped(description.times(request, "Replay")), null, since, response);
    }

    /** Streams the changes of a replay until it is over. */
    @GET
    @Path("{replay}/events")
    public void one(
            @Context ContainerRequestContext request,
            @PathParam("replay") String replay,
            @HeaderParam(HttpHeaders.LAST_EVENT_ID_HEADER) String since,
            @Suspended AsyncResponse response) {
        replays.get(replay);
        feeds.open(kind.mapped(description.times(request, "Replay")), replay, since, response);
    }
}
