package io.furrow.fields;

import java.util.ArrayList;
import java.util.List;

import org.locationtech.jts.geom.Coordinate;
import org.locationtech.jts.geom.Envelope;
import org.locationtech.jts.geom.Geometry;
import org.locationtech.jts.geom.GeometryFactory;
import org.locationtech.jts.geom.LinearRing;
import org.locationtech.jts.geom.Polygon;
import org.locationtech.jts.geom.PrecisionModel;
import org.locationtech.jts.geom.util.GeometryFixer;
import org.locationtech.jts.operation.valid.IsValidOp;
import org.locationtech.jts.operation.valid.TopologyValidationError;
import org.locationtech.jts.precision.GeometryPrecisionReducer;

import io.furrow.model.text.Counts;

/**
 * Converts the outline of a feature to a valid area in WGS 84, or rejects it with a reason. Every repair is noted:
 * corners that are not numbers, repeated corners, open rings, heights, rings without area, rings that cross themselves
 * or each other (repaired by JTS' {@code GeometryFixer}), the antimeridian. Edges are not densified.
 */
final class AreaRepair {
    private static final GeometryFactory SHAPES = new GeometryFactory();
    private static final Envelope EARTH = new Envelope(-180, 180, -90, 90);
    private static final PrecisionModel NANODEGREES = new PrecisionModel(1e9);
    private static final double METERS_PER_DEGREE = 6_371_000 * Math.PI / 180;

    private final Georeference georeference;
    private final List<String> notes = new ArrayList<>();
    private int open;
    private int repeated;
    private int unreadable;
    private int withoutArea;
    private boolean heights;
    private double edgeError;

    private AreaRepair(Georeference georeference) {
        this.georeference = georeference;
    }

    static RepairedArea repair(Outline outline, Georeference georeference) throws RejectedFeatureException {
        return new AreaRepair(georeference).repaired(outline);
    }

    static String closed(int rings) {
        return "closed " + Counts.of(rings, "ring");
    }

    private RepairedArea repaired(Outline outline) throws RejectedFeatureException {
        List<Polygon> polygons = new ArrayList<>();
        for (List<List<Coordinate>> polygon : outline.polygons()) {
            Polygon repaired = polygon(polygon);
            if (repaired != null) {
                polygons.add(repaired);
            }
        }
        if (polygons.isEmpty()) {
            throw new RejectedFeatureException(
                    outline.polygons().isEmpty() ? "has no geometry" : "has no ring that encloses an area");
        }
        Geometry area =
                polygons.size() == 1 ? polygons.get(0) : SHAPES.createMultiPolygon(polygons.toArray(Polygon[]::new));
        noteCounts();
        Geometry valid = rounded(cut(fixed(area)));
        List<String> all = new ArrayList<>(outline.notes());
        all.addAll(notes);
        return new RepairedArea(valid, all, edgeError);
    }

    private void noteCounts() {
        note(heights, Outline.HEIGHTS_LEFT_OUT);
        note(unreadable > 0, "left out " + Counts.of(unreadable, "corner") + " without a number");
        note(repeated > 0, "left out " + Counts.of(repeated, "repeated corner"));
        note(open > 0, closed(open));
        note(withoutArea > 0, "left out " + Counts.of(withoutArea, "ring") + " without area");
    }

    private void note(boolean condition, String text) {
        if (condition) {
            notes.add(text);
        }
    }

    /** Returns null if the shell encloses no area. */
    private Polygon polygon(List<List<Coordinate>> rings) throws RejectedFeatureException {
        LinearRing shell = null;
        List<LinearRing> holes = new ArrayList<>();
        for (int index = 0; index < rings.size(); index++) {
            List<Coordinate> corners = cleaned(rings.get(index));
            if (corners.size() < 3) {
                withoutArea++;
                if (index == 0) {
                    return null;
                }
                continue;
            }
            Coordinate[] ring = Rings.closed(Antimeridian.unrolled(reprojected(corners), shell));
            if (index == 0) {
                shell = SHAPES.createLinearRing(ring);
            } else {
                holes.add(SHAPES.createLinearRing(ring));
            }
        }
        return shell == null ? null : SHAPES.createPolygon(shell, holes.toArray(LinearRing[]::new));
    }

    /** Returns the open ring without corners that are not numbers or repeat the previous one. */
    private List<Coordinate> cleaned(List<Coordinate> ring) {
        List<Coordinate> clean = new ArrayList<>();
        for (Coordinate corner : ring) {
            heights |= !Double.isNaN(corner.getZ());
            if (!Double.isFinite(corner.x) || !Double.isFinite(corner.y)) {
                unreadable++;
            } else if (!clean.isEmpty() && clean.get(clean.size() - 1).equals2D(corner)) {
                repeated++;
            } else {
                clean.add(corner);
            }
        }
        if (clean.size() > 1 && Rings.isClosed(clean)) {
            clean.remove(clean.size() - 1);
        } else if (clean.size() > 2) {
            open++;
        }
        return clean;
    }

    private List<Coordinate> reprojected(List<Coordinate> ring) throws RejectedFeatureException {
        List<Coordinate> positions = new ArrayList<>(ring.size());
        for (Coordinate corner : ring) {
            positions.add(georeference.toWgs84(corner));
        }
        for (int index = 0; index < ring.size(); index++) {
            int next = (index + 1) % ring.size();
            Coordinate middle = georeference.toWgs84(new Coordinate(
                    (ring.get(index).x + ring.get(next).x) / 2, (ring.get(index).y + ring.get(next).y) / 2));
            edgeError = Math.max(edgeError, distance(middle, positions.get(index), positions.get(next)));
        }
        return positions;
    }

    /** Distance in meters from a position to the middle of an edge in longitude and latitude. */
    private static double distance(Coordinate middle, Coordinate from, Coordinate to) {
        double longitude = (Math.IEEEremainder(from.x - middle.x, 360) + Math.IEEEremainder(to.x - middle.x, 360)) / 2;
        double latitude = (from.y + to.y) / 2 - middle.y;
        return METERS_PER_DEGREE * Math.hypot(longitude * Math.cos(Math.toRadians(middle.y)), latitude);
    }

    private Geometry fixed(Geometry area) throws RejectedFeatureException {
        TopologyValidationError error = new IsValidOp(area).getValidationError();
        if (error == null) {
            return area;
        }
        Geometry fixed = GeometryFixer.fix(area);
        if (fixed.isEmpty()) {
            throw new RejectedFeatureException("encloses no area (" + describe(error) + ")");
        }
        notes.add("repaired: " + describe(error));
        return fixed;
    }

    private static String describe(TopologyValidationError error) {
        return error.getMessage() + " at " + Phrases.place(error.getCoordinate().x, error.getCoordinate().y);
    }

    /** Rounds to 0.1 mm if computed corners are too close to each other, or just beyond longitude 180. */
    private static Geometry rounded(Geometry area) throws RejectedFeatureException {
        if (isUsable(area)) {
            return area;
        }
        try {
            Geometry rounded = GeometryPrecisionReducer.reduce(area, NANODEGREES);
            if (!isUsable(rounded)) {
                throw new IllegalArgumentException("it is still not valid");
            }
            return rounded;
        } catch (IllegalArgumentException e) {
            throw new RejectedFeatureException("crosses itself in a way that cannot be repaired; redraw its border");
        }
    }

    private static boolean isUsable(Geometry area) {
        return !area.isEmpty() && area.isValid() && EARTH.contains(area.getEnvelopeInternal());
    }

    private Geometry cut(Geometry area) {
        Geometry cut = Antimeridian.cut(area);
        note(cut != area, "cut at the antimeridian");
        return cut;
    }
}
