package io.furrow.control.rest.view;

import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.clock.SettableClock;
import io.furrow.control.rest.access.ProblemException;
import io.furrow.mission.RecordingException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class EventTilesTest {
    private static final long HOUR = 3_600_000;
    private static final EventTiles.Tile FIRST = new EventTiles.Tile("m", 1000, 0);
    private static final MissionTimeline.Extent EXTENT = new MissionTimeline.Extent(0, HOUR - 1);

    private final Counter counter = new Counter();
    private final SettableClock clock = new SettableClock(Instant.ofEpochMilli(1_000_000));

    @AutoClose
    private final EventTiles tiles = new EventTiles(counter, clock);

    /** Counts one event in each bucket. */
    private static final class Counter implements EventTiles.Counter {
        final List<Long> requested = new CopyOnWriteArrayList<>();
        volatile CountDownLatch open = new CountDownLatch(0);
        volatile boolean unavailable;

        @Override
        public Optional<long[]> count(String mission, long from, long width, int buckets) throws RecordingException {
            requested.add(from);
            try {
                open.await();
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
            }
            if (unavailable) {
                throw new RecordingException("away", null);
            }
            long[] counts = new long[buckets];
            java.util.Arrays.fill(counts, 1);
            return mission.equals("m") ? Optional.of(counts) : Optional.empty();
        }

        @Override
        public void close() {
            open.countDown();
        }
    }

    private void count(EventTiles.Tile tile, long last) throws Exception {
        tiles.count(tile, last).get(10, TimeUnit.SECONDS);
    }

    private JsonNode timeline(long from, long to, int buckets) throws Exception {
        return MissionTimeline.of("m", EXTENT, from, to, buckets)
                .count(tiles, Runnable::run)
                .toCompletableFuture()
                .get(10, TimeUnit.SECONDS);
    }

    @Test
    void countsATileOnceForConcurrentRequests() throws Exception {
        counter.open = new CountDownLatch(1);
        CompletableFuture<EventTiles.TileCounts> one = tiles.count(FIRST, HOUR);
        CompletableFuture<EventTiles.TileCounts> other = tiles.count(FIRST, HOUR);
        counter.open.countDown();
        one.get(10, TimeUnit.SECONDS);

        assertThat(other.get(10, TimeUnit.SECONDS).counts()).hasSize(EventTiles.BUCKETS);
        count(FIRST, HOUR);
        assertThat(counter.requested).containsExactly(0L);
    }

    @Test
    void countsAgainAfterNewEvents() throws Exception {
        long end = FIRST.to();
        count(FIRST, end - 1);
        count(FIRST, end + 1);
        assertThat(counter.requested).as("the newest event was in the tile").hasSize(2);

        count(FIRST, end + 60_000);
        assertThat(counter.requested).as("a late event may have arrived").hasSize(3);
        count(FIRST, end + 120_000);
        assertThat(counter.requested).as("no later events expected").hasSize(3);

        clock.pass(Duration.ofMinutes(10));
        count(FIRST, end + 120_000);
        assertThat(counter.requested).as("older than ten minutes").hasSize(4);
    }

    @Test
    void doesNotCacheFailures() throws Exception {
        counter.unavailable = true;
        assertThatThrownBy(() -> count(FIRST, HOUR))
                .isInstanceOf(ExecutionException.class)
                .hasCauseInstanceOf(ProblemException.class)
                .hasMessageContaining("away");
        counter.unavailable = false;
        count(FIRST, HOUR);

        EventTiles.Tile unknown = new EventTiles.Tile("other", 1000, 0);
        assertThatThrownBy(() -> count(unknown, HOUR)).hasMessageContaining("mission 'other' is not recorded");
    }

    @Test
    void returnsPartialCountsAndTheRestLater() throws Exception {
        counter.open = new CountDownLatch(1);
        JsonNode first = timeline(0, HOUR, 500);
        assertThat(first.path("complete").asBoolean()).isFalse();
        assertThat(first.path("counts"))
                .hasSize(360)
                .allSatisfy(count -> assertThat(count.isNull()).isTrue());

        counter.open.countDown();
        JsonNode second = timeline(0, HOUR, 500);
        assertThat(second.path("complete").asBoolean()).isTrue();
        assertThat(second.path("width").asLong()).isEqualTo(10_000);
        assertThat(second.path("counts"))
                .hasSize(360)
                .allSatisfy(count -> assertThat(count.asLong()).isEqualTo(1));
        assertThat(counter.requested).containsExactly(0L, 2_560_000L);
    }

    @Test
    void choosesTheNarrowestSufficientWidth() throws Exception {
        assertWidth(0, HOUR, 1_000, 5_000, 720);
        assertWidth(0, HOUR, 720, 5_000, 720);
        assertWidth(0, HOUR, 719, 10_000, 360);
        assertWidth(1_234_567, 1_234_568, 240, 100, 1);
        assertWidth(0, 400 * 24 * HOUR, 100, 4 * 24 * HOUR, 1);
        assertWidth(-HOUR, 2 * HOUR, 1_080, 10_000, 360);

        ObjectNode moved = (ObjectNode) timeline(12_345, 22_345, 10);
        assertThat(moved.path("from").asLong()).as("a multiple of the width").isEqualTo(12_000);
        assertThat(moved.path("counts")).hasSize(11);
    }

    private static void assertWidth(long from, long to, int buckets, long width, int number) {
        MissionTimeline timeline = MissionTimeline.of("m", EXTENT, from, to, buckets);
        assertThat(timeline.width()).isEqualTo(width);
        assertThat(timeline.buckets()).isEqualTo(number);
    }
}
