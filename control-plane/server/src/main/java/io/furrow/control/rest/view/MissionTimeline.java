package io.furrow.control.rest.view;

import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.Executor;
import java.util.concurrent.TimeUnit;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.model.ngsi.NgsiJson;

/**
 * The number of events per bucket in a time range of a mission.
 *
 * @param from start of the first bucket, event time, epoch ms
 * @param width of a bucket, ms; one of a list of human-friendly widths
 * @param buckets number of buckets
 */
public record MissionTimeline(String mission, Extent extent, long from, long width, int buckets) {
    public static final int MAX_BUCKETS = 1_000;

    private static final long SECOND = 1_000;
    private static final long MINUTE = 60 * SECOND;
    private static final long HOUR = 60 * MINUTE;
    private static final long DAY = 24 * HOUR;
    private static final long[] WIDTHS = {
        100,
        200,
        500,
        SECOND,
        2 * SECOND,
        5 * SECOND,
        10 * SECOND,
        15 * SECOND,
        30 * SECOND,
        MINUTE,
        2 * MINUTE,
        5 * MINUTE,
        10 * MINUTE,
        15 * MINUTE,
        30 * MINUTE,
        HOUR,
        2 * HOUR,
        3 * HOUR,
        6 * HOUR,
        12 * HOUR,
        DAY
    };
    private static final long TIMEOUT_MS = 1_000;

    /** First and last event time of a mission, epoch ms. */
    public record Extent(long first, long last) {}

    /**
     * Returns the buckets of the part of a range in which the mission has events. Their width depends only on the
     * range, so that the buckets of several missions match.
     *
     * @param from epoch ms
     * @param to epoch ms, after {@code from}
     * @param maxBuckets maximum number of buckets, apart from partial ones at both ends
     */
    public static MissionTimeline of(String mission, Extent extent, long from, long to, int maxBuckets) {
        long width = width(to - from, maxBuckets);
        long begin = Math.floorDiv(Math.max(from, extent.first()), width) * width;
        long end = Math.min(to, extent.last() + 1);
        return new MissionTimeline(mission, extent, begin, width, Math.toIntExact(ceilDiv(end - begin, width)));
    }

    private static long width(long length, int maxBuckets) {
        for (long width : WIDTHS) {
            if (length <= width * maxBuckets) {
                return width;
            }
        }
        return ceilDiv(ceilDiv(length, maxBuckets), DAY) * DAY;
    }

    private static long ceilDiv(long length, long by) {
        return -Math.floorDiv(-length, by);
    }

    private List<EventTiles.Tile> tiles() {
        long length = width * EventTiles.BUCKETS;
        List<EventTiles.Tile> tiles = new ArrayList<>();
        for (long index = Math.floorDiv(from, length); index * length < from + buckets * width; index++) {
            tiles.add(new EventTiles.Tile(mission, width, index));
        }
        return tiles;
    }

    /**
     * Returns the answer after at most a second; tiles that were not counted by then are null, and available to a later
     * request.
     *
     * @param executor creates the answer
     * @return fails with a {@link ProblemException}
     */
    public CompletionStage<ObjectNode> count(EventTiles events, Executor executor) {
        List<EventTiles.Tile> tiles = tiles();
        List<CompletableFuture<EventTiles.TileCounts>> answers =
                tiles.stream().map(tile -> events.count(tile, extent.last())).toList();
        return CompletableFuture.allOf(answers.toArray(CompletableFuture[]::new))
                .completeOnTimeout(null, TIMEOUT_MS, TimeUnit.MILLISECONDS)
                .thenApplyAsync(counted -> json(tiles, answers), executor);
    }

    private ObjectNode json(List<EventTiles.Tile> tiles, List<CompletableFuture<EventTiles.TileCounts>> answers) {
        ObjectNode json = NgsiJson.object()
                .put("mission", mission)
                .put("first", extent.first())
                .put("last", extent.last())
                .put("from", from)
                .put("width", width);
        ArrayNode counts = json.putArray("counts");
        boolean complete = true;
        for (int i = 0; i < tiles.size(); i++) {
            EventTiles.TileCounts counted = answers.get(i).getNow(null);
            complete &= counted != null;
            add(tiles.get(i), counted, counts);
        }
        return json.put("complete", complete);
    }

    private void add(EventTiles.Tile tile, EventTiles.TileCounts counted, ArrayNode counts) {
        for (int bucket = 0; bucket < EventTiles.BUCKETS; bucket++) {
            long begin = tile.from() + bucket * width;
            if (begin >= from && begin < from + buckets * width) {
                if (counted == null) {
                    counts.addNull();
                } else {
                    counts.add(counted.counts()[bucket]);
                }
            }
        }
    }
}
