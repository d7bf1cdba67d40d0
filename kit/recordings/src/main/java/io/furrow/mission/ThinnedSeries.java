package io.furrow.mission;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.stream.IntStream;
import java.util.stream.Stream;

/**
 * Thins a series of numbers to a maximum of points, in memory that depends on this maximum only. As long as they are
 * few, it retains all points; then, of each of equal parts of the period, the lowest and the highest one, and the first
 * and the last of all. So no peak is lost. The order in which points are added does not matter, except among equal ones.
 */
public final class ThinnedSeries {
    public static final int MIN_POINTS = 10;

    private static final Comparator<Point> BY_TIME = Comparator.comparingLong(Point::time);

    private final long from;
    private final long partMillis;
    /** All points; null once they were too many. */
    private Point[] all;

    private Point[] lowest;
    private Point[] highest;
    private Point first;
    private Point last;
    private long count;

    /** @param time epoch ms */
    public record Point(long time, double value) {}

    /**
     * @param from epoch ms
     * @param to epoch ms, after {@code from}
     * @param maxPoints at least {@value #MIN_POINTS}
     */
    public ThinnedSeries(long from, long to, int maxPoints) {
        if (to <= from || maxPoints < MIN_POINTS) {
            throw new IllegalArgumentException(
                    "the period must have a length, and maxPoints must be at least %d: from=%d, to=%d, maxPoints=%d"
                            .formatted(MIN_POINTS, from, to, maxPoints));
        }
        this.from = from;
        this.all = new Point[maxPoints];
        // two points of each part, and the first and the last one
        this.partMillis = -Math.floorDiv(from - to, maxPoints / 2 - 1);
    }

    /** @param time epoch ms, within the period */
    public void add(long time, double value) {
        Point point = new Point(time, value);
        first = first == null || time < first.time() ? point : first;
        last = last == null || time >= last.time() ? point : last;
        if (all != null && count < all.length) {
            all[Math.toIntExact(count)] = point;
        } else {
            thin(point);
        }
        count++;
    }

    private void thin(Point point) {
        if (all != null) {
            Point[] existing = all;
            all = null;
            lowest = new Point[existing.length / 2 - 1];
            highest = new Point[lowest.length];
            Arrays.stream(existing).forEach(this::thin);
        }
        int part = Math.toIntExact((point.time() - from) / partMillis);
        if (lowest[part] == null || point.value() < lowest[part].value()) {
            lowest[part] = point;
        }
        if (highest[part] == null || point.value() > highest[part].value()) {
            highest[part] = point;
        }
    }

    /** Returns the number of points that were added. */
    public long count() {
        return count;
    }

    /** Returns the length of a part, ms; 0 if all points are retained. */
    public long partMillis() {
        return all == null ? partMillis : 0;
    }

    /** Returns the retained points in the order of their times. */
    public List<Point> points() {
        if (all != null) {
            return Arrays.stream(all, 0, Math.toIntExact(count)).sorted(BY_TIME).toList();
        }
        List<Point> points = new ArrayList<>();
        points.add(first);
        IntStream.range(0, lowest.length)
                .filter(part -> lowest[part] != null)
                .mapToObj(part -> Stream.of(lowest[part], highest[part]).sorted(BY_TIME))
                .flatMap(each -> each)
                .forEach(points::add);
        points.add(last);
        return points.stream().distinct().toList();
    }
}
