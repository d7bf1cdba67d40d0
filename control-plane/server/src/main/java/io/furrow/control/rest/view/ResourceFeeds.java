package io.furrow.control.rest.view;

import java.io.IOException;
import java.time.Duration;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.Semaphore;

import jakarta.ws.rs.container.AsyncResponse;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;
import org.glassfish.jersey.server.ChunkedOutput;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.rest.access.ProblemException;

/** Manages the clients that follow resources, at most {@value #MAX_FEEDS}, each with its own thread that writes to it. */
public final class ResourceFeeds implements StateView.Listener, AutoCloseable {
    static final int MAX_FEEDS = 100;

    private static final Logger LOG = LoggerFactory.getLogger(ResourceFeeds.class);
    private static final Duration HEARTBEAT = Duration.ofSeconds(15);

    private final Set<ResourceFeed> feeds = ConcurrentHashMap.newKeySet();
    private final Semaphore free = new Semaphore(MAX_FEEDS);

    /**
     * Answers with events until the client disconnects.
     *
     * @param only key of the resource, which must exist; null for all
     * @param since id of the last event that the client has received; null for none
     * @throws ProblemException if the topics were not read yet, or too many clients are connected
     */
    public void open(ResourceKind kind, String only, String since, AsyncResponse response) {
        kind.keys();
        if (!free.tryAcquire()) {
            throw new ProblemException(
                    503,
                    "overloaded",
                    "%d clients follow changes already; ask again later, or GET the list now and then"
                            .formatted(MAX_FEEDS));
        }
        ResourceFeed feed = new ResourceFeed(kind, only);
        feeds.add(feed);
        feed.begin(since);
        Thread thread = new Thread(() -> run(feed, response), "control-plane-feed");
        thread.setDaemon(true);
        thread.start();
    }

    /** Starts the answer on this thread, so that only this thread writes to the client and blocks. */
    private void run(ResourceFeed feed, AsyncResponse response) {
        try (ChunkedOutput<byte[]> output = new ChunkedOutput<>(byte[].class)) {
            response.resume(Response.ok(output)
                    .type(MediaType.SERVER_SENT_EVENTS_TYPE)
                    .header("Cache-Control", "no-store")
                    .header("X-Accel-Buffering", "no")
                    .build());
            feed.write(output::write, HEARTBEAT);
        } catch (IOException | ProblemException e) { // the client disconnected or does not read, or the view is rebuilt
            LOG.debug("a client no longer follows changes", e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        } finally {
            feeds.remove(feed);
            free.release();
        }
    }

    @Override
    public void changed(StateView.Change change) {
        feeds.forEach(feed -> feed.changed(change));
    }

    @Override
    public void completed() {
        feeds.forEach(ResourceFeed::changedAll);
    }

    @Override
    public void close() {
        feeds.forEach(ResourceFeed::close);
    }
}
