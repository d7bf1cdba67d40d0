package io.furrow.simulators.robot;

import java.util.ArrayDeque;
import java.util.Arrays;
import java.util.Deque;
import java.util.List;

import org.locationtech.jts.geom.Coordinate;
import org.locationtech.jts.geom.Polygon;
import org.locationtech.jts.geom.prep.PreparedGeometry;
import org.locationtech.jts.geom.prep.PreparedGeometryFactory;

/** The shortest ways between places of an area that do not leave it: along lines of sight between its corners (Dijkstra). */
final class Corridor {
    private final PreparedGeometry area;
    private final Coordinate[] corners;

    Corridor(Polygon area) {
        this.area = PreparedGeometryFactory.prepare(area);
        this.corners = Arrays.stream(area.getCoordinates()).distinct().toArray(Coordinate[]::new);
    }

    /** The way from one place of the area to another, both included. */
    List<Coordinate> between(Coordinate from, Coordinate to) {
        if (sees(from, to)) {
            return List.of(from, to);
        }
        Coordinate[] places = Arrays.copyOf(corners, corners.length + 2);
        int start = corners.length;
        int goal = corners.length + 1;
        places[start] = from;
        places[goal] = to;
        int[] before = shortest(places, start, goal);
        Deque<Coordinate> way = new ArrayDeque<>();
        for (int at = goal; at >= 0; at = before[at]) {
            way.addFirst(places[at]);
        }
        return List.copyOf(way);
    }

    /** Of each place the one before it on the shortest way from the start; -1 of the start itself. */
    private int[] shortest(Coordinate[] places, int start, int goal) {
        double[] length = new double[places.length];
        int[] before = new int[places.length];
        boolean[] done = new boolean[places.length];
        Arrays.fill(length, Double.POSITIVE_INFINITY);
        Arrays.fill(before, -1);
        length[start] = 0;
        while (!done[goal]) {
            int next = nearest(length, done);
            if (next < 0) {
                throw new IllegalStateException("no way inside from " + places[start] + " to " + places[goal]);
            }
            done[next] = true;
            for (int other = 0; other < places.length; other++) {
                double via = length[next] + places[next].distance(places[other]);
                if (!done[other] && via < length[other] && sees(places[next], places[other])) {
                    length[other] = via;
                    before[other] = next;
                }
            }
        }
        return before;
    }

    private static int nearest(double[] length, boolean[] done) {
        int nearest = -1;
        for (int i = 0; i < length.length; i++) {
            if (!done[i] && length[i] < Double.POSITIVE_INFINITY && (nearest < 0 || length[i] < length[nearest])) {
                nearest = i;
            }
        }
        return nearest;
    }

    private boolean sees(Coordinate from, Coordinate to) {
        return area.covers(WorkField.GEOMETRIES.createLineString(new Coordinate[] {from, to}));
    }
}
