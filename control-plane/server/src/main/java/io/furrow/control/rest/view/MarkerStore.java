package io.furrow.control.rest.view;

import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.Executor;
import java.util.concurrent.RejectedExecutionException;
import java.util.concurrent.ThreadPoolExecutor;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.replay.ReplaySettings;
import io.furrow.control.rest.access.ProblemException;
import io.furrow.kafka.DaemonThreads;
import io.furrow.mission.RecordingException;
import io.furrow.mission.marker.Markers;
import io.furrow.mission.marker.RejectedMarkerException;
import io.furrow.mission.mongo.MissionCatalog;
import io.furrow.model.control.ErrorCode;

/**
 * Accesses markers in MongoDB, and deletes missions, on its own thread, so that requests do not block threads of the API. At most
 * {@value #MAX_WAITING} requests wait.
 */
public final class MarkerStore implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(MarkerStore.class);
    private static final int MAX_WAITING = 64;

    private final ReplaySettings settings;
    private final Executor resultExecutor;
    private final ThreadPoolExecutor executor = DaemonThreads.single("control-plane-markers", MAX_WAITING);
    /** Used by the executor's thread only. */
    private Markers markers;

    /** A query or change. @param <T> type of the result */
    public interface Query<T> {
        T request(Markers markers) throws RejectedMarkerException, RecordingException;
    }

    /** @param resultExecutor completes the results */
    public MarkerStore(ReplaySettings settings, Executor resultExecutor) {
        this.settings = settings;
        this.resultExecutor = resultExecutor;
    }

    /**
     * Returns the result, or fails with a {@link ProblemException}: 400 for an invalid marker, 503 if MongoDB is
     * unavailable.
     *
     * @throws ProblemException if there is no MongoDB, or too many requests are waiting
     */
    public <T> CompletionStage<T> request(Query<T> query) {
        if (settings.mongo() == null) {
            throw ProblemException.noMongo();
        }
        CompletableFuture<T> answer = new CompletableFuture<>();
        try {
            executor.execute(() -> request(query, answer));
        } catch (RejectedExecutionException e) {
            throw ProblemException.overloaded();
        }
        return answer.whenCompleteAsync((result, failure) -> {}, resultExecutor);
    }

    /** What was deleted of a mission, or would be. @param events as the server remembers it */
    public record Purge(long events, long markers) {}

    /**
     * Deletes the events and markers of a mission.
     *
     * @param dryRun whether they are only counted
     * @param check fails if the mission is in use; called at the last moment
     * @return fails as {@link #request}, and with 404 if the mission is not stored
     */
    public CompletionStage<Purge> purge(String mission, boolean dryRun, Runnable check) {
        return request(stored -> {
            try (MissionCatalog catalog = MissionCatalog.open(settings.mongo(), settings.database())) {
                long events = catalog.events(mission).orElseThrow(() -> EventTiles.unknown(mission));
                check.run();
                if (dryRun) {
                    return new Purge(events, stored.list(mission).size());
                }
                long removed = stored.removeAll(mission);
                catalog.delete(mission);
                return new Purge(events, removed);
            }
        });
    }

    private <T> void request(Query<T> query, CompletableFuture<T> answer) {
        try {
            if (markers == null) {
                markers = Markers.open(settings.mongo(), settings.database());
            }
            answer.complete(query.request(markers));
        } catch (RejectedMarkerException e) {
            answer.completeExceptionally(new ProblemException(ErrorCode.WRONG_MEMBER, e.getMessage()));
        } catch (RecordingException e) {
            answer.completeExceptionally(new ProblemException(503, "mongodb-away", e.getMessage()));
        } catch (RuntimeException e) { // also a bug must complete the answer
            answer.completeExceptionally(e);
        }
    }

    @Override
    public void close() {
        try {
            executor.execute(() -> {
                if (markers != null) {
                    markers.close();
                }
            });
        } catch (RejectedExecutionException e) {
            LOG.debug("the client of MongoDB was not closed, because too many requests are waiting", e);
        }
        executor.shutdown();
    }
}
