package io.furrow.control.rest.view;

import java.time.Clock;
import java.time.Duration;
import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.RejectedExecutionException;
import java.util.concurrent.ThreadPoolExecutor;

import io.furrow.control.replay.ReplaySettings;
import io.furrow.control.rest.access.ProblemException;
import io.furrow.kafka.BoundedMap;
import io.furrow.kafka.DaemonThreads;
import io.furrow.mission.RecordingException;
import io.furrow.mission.mongo.EventDensity;
import io.furrow.model.control.ErrorCode;

/**
 * Counts the events of missions in tiles, like those of a map: a tile consists of {@value #BUCKETS} buckets of equal
 * width and begins at a multiple of its length, so that views that pan and zoom share tiles. One thread queries
 * MongoDB; counts are cached.
 */
public final class EventTiles implements AutoCloseable {
    /** Number of buckets of a tile. */
    static final int BUCKETS = 256;

    private static final int MAX_WAITING = 64;
    private static final int MAX_CACHED = 2_000;
    private static final long FRESH_MS = 600_000;
    /** Maximum delay of events. */
    private static final long LATENESS_MS = 60_000;

    private final Counter counter;
    private final Clock clock;
    private final Map<Tile, CompletableFuture<TileCounts>> waiting = new HashMap<>();
    private final Map<Tile, TileCounts> cached = BoundedMap.byAccess(MAX_CACHED);
    private final ThreadPoolExecutor counting = DaemonThreads.single("control-plane-timelines", MAX_WAITING);

    /** @param index the tile begins at the event time {@code index * BUCKETS * width} */
    record Tile(String mission, long width, long index) {
        long from() {
            return index * BUCKETS * width;
        }

        long to() {
            return from() + BUCKETS * width;
        }
    }

    /**
     * @param counts of each bucket
     * @param last newest known event of the mission at that time, epoch ms
     * @param at when it was counted, epoch ms
     */
    record TileCounts(long[] counts, long last, long at) {}

    interface Counter extends AutoCloseable {
        Optional<long[]> count(String mission, long from, long width, int buckets) throws RecordingException;

        @Override
        void close();
    }

    EventTiles(Counter counter, Clock clock) {
        this.counter = counter;
        this.clock = clock;
    }

    /** Creates tiles without waiting for MongoDB. @return null if the control plane has no MongoDB */
    public static EventTiles of(ReplaySettings settings) {
        return settings.mongo() == null
                ? null
                : new EventTiles(
                        new MongoCounter(EventDensity.open(settings.mongo(), settings.database())), Clock.systemUTC());
    }

    private record MongoCounter(EventDensity density) implements Counter {
        @Override
        public Optional<long[]> count(String mission, long from, long width, int buckets) throws RecordingException {
            return density.count(mission, from, width, buckets);
        }

        @Override
        public void close() {
            density.close();
        }
    }

    /**
     * Returns the counts of a tile, immediately if they are cached. They are counted again after ten minutes, or if the
     * mission has newer events that may lie in the tile.
     *
     * @param last newest known event of the mission, epoch ms
     * @return fails with a {@link ProblemException}
     */
    CompletableFuture<TileCounts> count(Tile tile, long last) {
        synchronized (cached) {
            TileCounts existing = cached.get(tile);
            if (existing != null && isFresh(tile, existing, last)) {
                return CompletableFuture.completedFuture(existing);
            }
            CompletableFuture<TileCounts> requested = waiting.get(tile);
            if (requested != null) {
                return requested;
            }
            CompletableFuture<TileCounts> answer = new CompletableFuture<>();
            try {
                counting.execute(() -> count(tile, last, answer));
                waiting.put(tile, answer);
            } catch (RejectedExecutionException e) {
                answer.completeExceptionally(ProblemException.overloaded());
            }
            return answer;
        }
    }

    /** Forgets all counts, because a mission was deleted. */
    public void forget() {
        synchronized (cached) {
            cached.clear();
        }
    }

    private boolean isFresh(Tile tile, TileCounts existing, long last) {
        boolean complete = existing.last() == last || tile.to() <= existing.last() - LATENESS_MS;
        return complete && clock.millis() - existing.at() < FRESH_MS;
    }

    private void count(Tile tile, long last, CompletableFuture<TileCounts> answer) {
        try {
            long startedAt = clock.millis();
            TileCounts counted = counter.count(tile.mission(), tile.from(), tile.width(), BUCKETS)
                    .map(counts -> new TileCounts(counts, last, startedAt))
                    .orElseThrow(() -> unknown(tile.mission()));
            synchronized (cached) {
                cached.put(tile, counted);
                waiting.remove(tile);
            }
            answer.complete(counted);
        } catch (RecordingException e) {
            fail(tile, answer, new ProblemException(503, "mongodb-away", e.getMessage()));
        } catch (RuntimeException e) { // also a bug must complete the answer
            fail(tile, answer, e);
        }
    }

    private void fail(Tile tile, CompletableFuture<TileCounts> answer, RuntimeException failure) {
        synchronized (cached) {
            waiting.remove(tile);
        }
        answer.completeExceptionally(failure);
    }

    public static ProblemException unknown(String mission) {
        return new ProblemException(
                ErrorCode.UNKNOWN_MISSION,
                "mission '%s' is not recorded; GET /api/recordings lists the recorded ones".formatted(mission));
    }

    @Override
    public void close() {
        counting.shutdownNow();
        DaemonThreads.await(counting, Duration.ofSeconds(1));
        counter.close();
    }
}
