package io.furrow.fields;

import java.util.ArrayList;
import java.util.List;

import org.locationtech.jts.algorithm.Orientation;
import org.locationtech.jts.algorithm.PointLocation;
import org.locationtech.jts.geom.Coordinate;
import org.locationtech.jts.geom.Location;

/** Helpers for rings of coordinates, closed or open. */
final class Rings {
    private static final int SMALLEST = 4;

    private Rings() {}

    /** Whether the ring has at least three corners. */
    static boolean isArea(List<Coordinate> ring) {
        return closed(ring).length >= SMALLEST;
    }

    static Coordinate[] closed(List<Coordinate> ring) {
        List<Coordinate> closed = new ArrayList<>(ring);
        if (!isClosed(ring)) {
            closed.add(ring.get(0).copy());
        }
        return closed.toArray(Coordinate[]::new);
    }

    static boolean isClosed(List<Coordinate> ring) {
        return ring.isEmpty() || ring.get(0).equals2D(ring.get(ring.size() - 1));
    }

    /**
     * Builds polygons from nested rings of any orientation: a ring inside an even number of others is a shell, a ring
     * inside an odd number is a hole of the innermost shell around it.
     */
    static List<List<List<Coordinate>>> nested(List<List<Coordinate>> rings) {
        int[] depth = new int[rings.size()];
        for (int ring = 0; ring < rings.size(); ring++) {
            for (int other = 0; other < rings.size(); other++) {
                if (ring != other && contains(rings.get(other), rings.get(ring))) {
                    depth[ring]++;
                }
            }
        }
        List<List<List<Coordinate>>> polygons = new ArrayList<>();
        for (int shell = 0; shell < rings.size(); shell++) {
            if (depth[shell] % 2 == 0) {
                List<List<Coordinate>> polygon = new ArrayList<>(List.of(rings.get(shell)));
                for (int hole = 0; hole < rings.size(); hole++) {
                    if (depth[hole] == depth[shell] + 1 && contains(rings.get(shell), rings.get(hole))) {
                        polygon.add(rings.get(hole));
                    }
                }
                polygons.add(polygon);
            }
        }
        return polygons;
    }

    /** Whether the first corner of the inner ring that is not on the outer ring lies inside; false if there is no such corner. */
    private static boolean contains(List<Coordinate> outer, List<Coordinate> inner) {
        if (!isArea(outer)) {
            return false;
        }
        Coordinate[] border = closed(outer);
        for (Coordinate corner : inner) {
            int location = PointLocation.locateInRing(corner, border);
            if (location != Location.BOUNDARY) {
                return location == Location.INTERIOR;
            }
        }
        return false;
    }

    /** Counts rings of the wrong orientation. @param counterClockwise expected orientation of shells; holes have the opposite */
    static int countReversed(List<List<List<Coordinate>>> polygons, boolean counterClockwise) {
        int reversed = 0;
        for (List<List<Coordinate>> polygon : polygons) {
            for (int ring = 0; ring < polygon.size(); ring++) {
                boolean expected = counterClockwise == (ring == 0);
                reversed += isArea(polygon.get(ring)) && Orientation.isCCWArea(closed(polygon.get(ring))) != expected
                        ? 1
                        : 0;
            }
        }
        return reversed;
    }
}
