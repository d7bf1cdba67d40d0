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
import io.furrow.model.control.ErrorCode;

/** Asks MongoDB for markers on a thread of its own, so that no request waits on those of the API. At most {@value #MAX_WAITING} wait. */
public final class MarkerStore implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(MarkerStore.class);
    private static final int MAX_WAITING = 64;

    private final ReplaySettings settings;
    private final Executor answering;
    private final ThreadPoolExecutor executor = DaemonThreads.single("control-plane-markers", MAX_WAITING);
    /** Of the thread that asks. */
    private Markers markers;

    /** What is asked. @param <T> the answer */
    public interface Query<T> {
        T request(Markers markers) throws RejectedMarkerException, RecordingException;
    }

    /** @param answering answers are forwarded by it */
    public MarkerStore(ReplaySettings settings, Executor answering) {
        this.settings = settings;
        this.answering = answering;
    }

    /**
     * The answer, or a {@link ProblemException}: 400 for what MongoDB is not given, 503 where it is unavailable.
     *
     * @throws ProblemException if there is no MongoDB, or too much waits already
     */
    public <T> CompletionStage<T> request(Query<T> question) {
        if (settings.mongo() == null) {
            throw new ProblemException(
                    501, "no-mongodb", "this control plane was started without --mongo, where markers are kept");
        }
        CompletableFuture<T> answer = new CompletableFuture<>();
        try {
            executor.execute(() -> request(question, answer));
        } catch (RejectedExecutionException e) {
            throw ProblemException.overloaded();
        }
        return answer.whenCompleteAsync((given, failure) -> {}, answering);
    }

    private <T> void request(Query<T> question, CompletableFuture<T> answer) {
        try {
            if (markers == null) {
                markers = Markers.open(settings.mongo(), settings.database());
            }
            answer.complete(question.request(markers));
        } catch (RejectedMarkerException e) {
            answer.completeExceptionally(new ProblemException(ErrorCode.WRONG_MEMBER, e.getMessage()));
        } catch (RecordingException e) {
            answer.completeExceptionally(new ProblemException(503, "mongodb-away", e.getMessage()));
        } catch (RuntimeException e) { // a fault of ours, which must not leave the caller without an answer
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
            LOG.debug("Too much is asked of MongoDB to take leave of it", e);
        }
        executor.shutdown();
    }
}
