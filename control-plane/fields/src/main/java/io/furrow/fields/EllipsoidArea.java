package io.furrow.fields;

import org.locationtech.jts.geom.CoordinateSequence;
import org.locationtech.jts.geom.CoordinateSequenceFilter;
import org.locationtech.jts.geom.Geometry;

/**
 * Computes areas on the WGS 84 ellipsoid, exact for edges that are straight in the cylindrical equal-area projection
 * (Snyder, Map Projections, 1987, 3-12 and 10-14, 10-15).
 */
final class EllipsoidArea {
    private static final double A = 6_378_137;
    private static final double E2 = 0.00669437999014;
    private static final double E = Math.sqrt(E2);
    private static final double SQUARE_METERS_PER_HECTARE = 10_000;

    private EllipsoidArea() {}

    static double hectares(Geometry area) {
        Geometry projected = area.copy();
        projected.apply(new EqualArea());
        return projected.getArea() / SQUARE_METERS_PER_HECTARE;
    }

    private static final class EqualArea implements CoordinateSequenceFilter {
        @Override
        public void filter(CoordinateSequence corners, int index) {
            double sine = Math.sin(Math.toRadians(corners.getY(index)));
            double q = (1 - E2) * (sine / (1 - E2 * sine * sine) - Math.log((1 - E * sine) / (1 + E * sine)) / (2 * E));
            corners.setOrdinate(index, 0, A * Math.toRadians(corners.getX(index)));
            corners.setOrdinate(index, 1, A * q / 2);
        }

        @Override
        public boolean isDone() {
            return false;
        }

        @Override
        public boolean isGeometryChanged() {
            return true;
        }
    }
}
