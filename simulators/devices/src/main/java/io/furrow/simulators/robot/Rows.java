package io.furrow.simulators.robot;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;

import org.locationtech.jts.algorithm.MinimumAreaRectangle;
import org.locationtech.jts.geom.Coordinate;
import org.locationtech.jts.geom.Envelope;
import org.locationtech.jts.geom.Geometry;
import org.locationtech.jts.geom.LineSegment;
import org.locationtech.jts.geom.LineString;
import org.locationtech.jts.geom.util.AffineTransformation;

/**
 * The rows of a field in order of work: parallel, {@code spacing} meters apart, up one and down the next, at least
 * {@code margin} meters from the edge.
 */
final class Rows {
    /** Shorter pieces are skipped. */
    static final double MIN = 0.5;

    private static final int MAX_ROWS = 10_000;

    private Rows() {}

    /**
     * @param bearing direction of the rows, degrees clockwise from north; null for that of the field's longer side
     * @throws IllegalArgumentException if the field has no room for a row, or there are more than {@value #MAX_ROWS}
     */
    static List<LineSegment> of(WorkField field, double spacing, double margin, Double bearing) {
        double angle = bearing == null ? longerSide(field.area()) : Math.toRadians(90 - bearing);
        Coordinate pivot = field.area().getCentroid().getCoordinate();
        Geometry flat = AffineTransformation.rotationInstance(-angle, pivot.x, pivot.y)
                .transform(field.area().buffer(-margin));
        AffineTransformation back = AffineTransformation.rotationInstance(angle, pivot.x, pivot.y);
        List<LineSegment> rows = new ArrayList<>();
        boolean east = true;
        Envelope extent = flat.getEnvelopeInternal();
        if (extent.getHeight() / spacing > MAX_ROWS) {
            throw new IllegalArgumentException(
                    "field '%s' has more than %d rows %s m apart: give a greater spacing, or a smaller field"
                            .formatted(field.id(), MAX_ROWS, spacing));
        }
        for (double y = extent.getMinY() + spacing / 2; y < extent.getMaxY(); y += spacing) {
            for (LineSegment piece : pieces(flat, y, east)) {
                rows.add(new LineSegment(turned(back, piece.p0), turned(back, piece.p1)));
            }
            east = !east;
        }
        if (rows.isEmpty()) {
            throw new IllegalArgumentException(
                    "field '%s' has no room for a row %s m from its edge: give a smaller margin"
                            .formatted(field.id(), margin));
        }
        return rows;
    }

    private static List<LineSegment> pieces(Geometry flat, double y, boolean east) {
        Envelope extent = flat.getEnvelopeInternal();
        Geometry line = WorkField.GEOMETRIES.createLineString(
                new Coordinate[] {new Coordinate(extent.getMinX() - 1, y), new Coordinate(extent.getMaxX() + 1, y)});
        Geometry cut = flat.intersection(line);
        List<LineSegment> pieces = new ArrayList<>();
        for (int i = 0; i < cut.getNumGeometries(); i++) {
            if (cut.getGeometryN(i) instanceof LineString piece && piece.getLength() >= MIN) {
                Envelope along = piece.getEnvelopeInternal();
                Coordinate west = new Coordinate(along.getMinX(), y);
                Coordinate end = new Coordinate(along.getMaxX(), y);
                pieces.add(east ? new LineSegment(west, end) : new LineSegment(end, west));
            }
        }
        Comparator<LineSegment> fromWest = Comparator.comparingDouble(piece -> piece.p0.x);
        pieces.sort(east ? fromWest : fromWest.reversed());
        return pieces;
    }

    private static Coordinate turned(AffineTransformation back, Coordinate place) {
        return back.transform(place, new Coordinate());
    }

    /** Angle of the longer side of the smallest enclosing rectangle, radians counter-clockwise from east. */
    private static double longerSide(Geometry area) {
        Coordinate[] corners = MinimumAreaRectangle.getMinimumRectangle(area).getCoordinates();
        boolean first = corners[0].distance(corners[1]) >= corners[1].distance(corners[2]);
        Coordinate from = corners[first ? 0 : 1];
        Coordinate to = corners[first ? 1 : 2];
        return Math.atan2(to.y - from.y, to.x - from.x);
    }
}
