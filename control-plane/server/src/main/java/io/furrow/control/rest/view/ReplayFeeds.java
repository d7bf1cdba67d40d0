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
import io.furrow.model.topic.Topics;

/** Manages the clients that follow replays, at most {@value #MAX_FEEDS}, each with its own thread that writes to it. */
public final class ReplayFeeds implements StateView.Listener, AutoCloseable {
    static final int MAX_FEEDS = 100;

    private static final Logger LOG = LoggerFactory.getLogger(ReplayFeeds.class);
    private static final Duration HEARTBEAT = Duration.ofSeconds(15);

    private final ReplayStatusView replays;
    private final Set<ReplayFeed> feeds = ConcurrentHashMap.newKeySet();
    private final Semaphore free = new Semaphore(MAX_FEEDS);

    public ReplayFeeds(ReplayStatusView replays) {
        this.replays = replays;
    }

    /**
     * Answers with events until the client disconnects.
     *
     * @param only null for all replays
     * @throws ProblemException if there is no such replay, the topics were not read yet, or too many clients are
     *     connected
     */
    public void open(String only, AsyncResponse response) {
        if (only == null) {
            replays.names();
        } else {
            replays.get(only);
        }
        if (!free.tryAcquire()) {
            throw new ProblemException(
                    503,
                    "overloaded",
                    "%d clients follow replays already; ask again later, or GET /api/replays now and then"
                            .formatted(MAX_FEEDS));
        }
        ReplayFeed feed = new ReplayFeed(replays, only);
        feeds.add(feed);
        Thread thread = new Thread(() -> run(feed, response), "control-plane-replay-feed");
        thread.setDaemon(true);
        thread.start();
    }

    /** Starts the answer on this thread, so that only this thread writes to the client and blocks. */
    private void run(ReplayFeed feed, AsyncResponse response) {
        try (ChunkedOutput<byte[]> output = new ChunkedOutput<>(byte[].class)) {
            response.resume(Response.ok(output)
                    .type(MediaType.SERVER_SENT_EVENTS_TYPE)
                    .header("Cache-Control", "no-store")
                    .header("X-Accel-Buffering", "no")
                    .build());
            feed.write(output::write, HEARTBEAT);
        } catch (IOException | ProblemException e) { // the client disconnected or does not read, or the view is rebuilt
            LOG.debug("a client no longer follows replays", e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        } finally {
            feeds.remove(feed);
            free.release();
        }
    }

    int size() {
        return feeds.size();
    }

    @Override
    public void changed(String topic, String key) {
        if (topic.equals(Topics.REPLAYS) || topic.equals(Topics.REPLAYS_STATUS)) {
            feeds.forEach(feed -> feed.changed(key));
        }
    }

    @Override
    public void completed() {
        feeds.forEach(ReplayFeed::changedAll);
    }

    @Override
    public void close() {
        feeds.forEach(ReplayFeed::close);
    }
}
