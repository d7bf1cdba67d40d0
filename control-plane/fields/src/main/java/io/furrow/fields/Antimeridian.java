package io.furrow.fields;

import java.util.ArrayList;
import java.util.List;

import org.locationtech.jts.geom.Coordinate;
import org.locationtech.jts.geom.Envelope;
import org.locationtech.jts.geom.Geometry;
import org.locationtech.jts.geom.LinearRing;
import org.locationtech.jts.geom.Polygon;
import org.locationtech.jts.geom.util.AffineTransformation;
import org.locationtech.jts.operation.overlayng.OverlayNG;
import org.locationtech.jts.operation.overlayng.OverlayNGRobust;

/**
 * Handles areas that cross longitude 180: unrolls them for processing and cuts them for output (RFC 7946, section
 * 3.1.9).
 */
final class Antimeridian {
    private static final double ROUND = 360;

    private Antimeridian() {}

    /**
     * Returns the ring without jumps: each corner is at most 180 degrees from the one before, because a field is never
     * wider than half the earth.
     *
     * @param shell the enclosing ring, used as reference; null if the ring is a shell
     * @throws RejectedFeatureException if the ring encloses a pole
     */
    static List<Coordinate> unrolled(List<Coordinate> ring, LinearRing shell) throws RejectedFeatureException {
        double last = shell == null
                ? Math.IEEEremainder(ring.get(0).x, ROUND)
                : shell.getEnvelopeInternal().centre().x;
        List<Coordinate> unrolled = new ArrayList<>(ring.size());
        for (Coordinate corner : ring) {
            last += Math.IEEEremainder(corner.x - last, ROUND);
            // Corners that are not shifted retain every digit.
            double x = Math.abs(last - corner.x) < 1 ? corner.x : last;
            unrolled.add(new Coordinate(x, corner.y));
        }
        double first = unrolled.get(0).x;
        if (Math.abs(last + Math.IEEEremainder(first - last, ROUND) - first) > 1) {
            throw new RejectedFeatureException("goes round a pole, where longitude and latitude define no interior");
        }
        return unrolled;
    }

    /** Returns the same geometry if it lies within ±180, else a MultiPolygon of the parts on each side. */
    static Geometry cut(Geometry area) {
        Envelope reach = area.getEnvelopeInternal();
        if (reach.getMinX() >= -180 && reach.getMaxX() <= 180) {
            return area;
        }
        List<Polygon> parts = new ArrayList<>();
        for (int shift = -2; shift <= 2; shift++) {
            Envelope side = new Envelope(shift * ROUND - 180, shift * ROUND + 180, -90, 90);
            if (side.intersects(reach)) {
                Geometry inside =
                        OverlayNGRobust.overlay(area, area.getFactory().toGeometry(side), OverlayNG.INTERSECTION);
                add(AffineTransformation.translationInstance(-shift * ROUND, 0).transform(inside), parts);
            }
        }
        return parts.size() == 1 ? parts.get(0) : area.getFactory().createMultiPolygon(parts.toArray(Polygon[]::new));
    }

    private static void add(Geometry geometry, List<Polygon> parts) {
        for (int part = 0; part < geometry.getNumGeometries(); part++) {
            if (geometry.getGeometryN(part) instanceof Polygon polygon && !polygon.isEmpty()) {
                parts.add(polygon);
            }
        }
    }
}
