package io.furrow.control.rest;

import jakarta.ws.rs.GET;
import jakarta.ws.rs.HEAD;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.PathParam;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.container.AsyncResponse;
import jakarta.ws.rs.container.Suspended;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;

import io.furrow.control.rest.view.ReplayFeeds;

/** {@code /api/replays/events}: changes of replays as server-sent events. */
@Path("/api/replays")
@Produces({MediaType.SERVER_SENT_EVENTS, MediaType.APPLICATION_JSON})
public final class ReplayFeedResource {
    private final ReplayFeeds feeds;

    ReplayFeedResource(ReplayFeeds feeds) {
        this.feeds = feeds;
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
    public void all(@Suspended AsyncResponse response) {
        feeds.open(null, response);
    }

    /** Streams the changes of a replay until it is over. */
    @GET
    @Path("{replay}/events")
    public void one(@PathParam("replay") String replay, @Suspended AsyncResponse response) {
        feeds.open(replay, response);
    }
}
