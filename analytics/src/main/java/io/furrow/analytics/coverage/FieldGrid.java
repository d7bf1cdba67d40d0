package io.furrow.analytics.coverage;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;

import org.locationtech.jts.geom.Coordinate;
import org.locationtech.jts.geom.Envelope;
import org.locationtech.jts.geom.Geometry;
import org.locationtech.jts.geom.LineString;
import org.locationtech.jts.geom.util.LinearComponentExtracter;

/**
 * A grid of square cells over a field, in meters east and north of the south-west corner of its bounding box: longitudes and latitudes
 * are projected linearly at the box's middle latitude, on a sphere of 6,371 km. A cell belongs to the field when its center does.
 *
 * <p>64 cells of a row are the bits of a word, 64 words of consecutive rows a tile.
 */
final class FieldGrid {
    /** Words of a tile. */
    static final int TILE = 64;
    /** Maximum number of cells; a larger field has larger cells. */
    static final int MAX_CELLS = 1 << 22;

    /** Meters. */
    static final double EARTH_RADIUS = 6_371_000;

    private static final double METERS_PER_DEGREE = Math.toRadians(EARTH_RADIUS);

    private final Envelope box;
    private final double metersPerDegreeEast;
    private final double cell;
    private final int columns;
    private final int rows;
    private final long[] inside;
    private final int cells;

    /** Receives cells of the field as the bits of a word. */
    interface Words {
        void accept(int word, long bits) throws Exception;
    }

    private FieldGrid(Geometry area, double cell) {
        box = area.getEnvelopeInternal();
        metersPerDegreeEast = METERS_PER_DEGREE * StrictMath.cos(Math.toRadians(box.centre().y));
        double width = box.getWidth() * metersPerDegreeEast;
        double height = box.getHeight() * METERS_PER_DEGREE;
        this.cell = cell * Math.max(1, Math.ceil(Math.sqrt(width * height / (cell * cell * MAX_CELLS))));
        columns = (int) (width / this.cell) + 1;
        rows = (int) (height / this.cell) + 1;
        inside = new long[tiles() * TILE];
        fill(area);
        cells = Arrays.stream(inside).mapToInt(Long::bitCount).sum();
    }

    /**
     * @param area as in {@link io.furrow.analytics.field.Field}
     * @param cell side of a cell, meters; a multiple of it if there would be more than {@value #MAX_CELLS} cells
     */
    static FieldGrid of(Geometry area, double cell) {
        return new FieldGrid(area, cell);
    }

    /** The bounding box in degrees, whose south-west corner is that of the first cell. */
    Envelope box() {
        return box;
    }

    /** Degrees of longitude and latitude of a cell. */
    Coordinate degreesOfCell() {
        return new Coordinate(cell / metersPerDegreeEast, cell / METERS_PER_DEGREE);
    }

    /** Side of a cell, meters. */
    double cell() {
        return cell;
    }

    int columns() {
        return columns;
    }

    int rows() {
        return rows;
    }

    /** Number of cells of the field. */
    int cells() {
        return cells;
    }

    int tiles() {
        return tilesPerRow() * ((rows + TILE - 1) / TILE);
    }

    /** The southernmost row of a tile. */
    int rowOf(int tile) {
        return tile / tilesPerRow() * TILE;
    }

    /** The westernmost column of a tile. */
    int columnOf(int tile) {
        return tile % tilesPerRow() * Long.SIZE;
    }

    private int tilesPerRow() {
        return (columns + Long.SIZE - 1) / Long.SIZE;
    }

    int word(int row, int column) {
        return (row / TILE * tilesPerRow() + column / Long.SIZE) * TILE + row % TILE;
    }

    /** Cells of the field among those of a word. */
    long inside(int word) {
        return inside[word];
    }

    boolean isInside(int row, int column) {
        return (inside[word(row, column)] >>> column & 1) != 0;
    }

    Coordinate toMeters(double longitude, double latitude) {
        return new Coordinate(
                (longitude - box.getMinX()) * metersPerDegreeEast, (latitude - box.getMinY()) * METERS_PER_DEGREE);
    }

    /** The cells of the field whose centers are in a convex polygon, border included, given by its corners in meters. */
    void cellsIn(Coordinate[] corners, Words out) throws Exception {
        double south = Double.POSITIVE_INFINITY;
        double north = Double.NEGATIVE_INFINITY;
        for (Coordinate corner : corners) {
            south = Math.min(south, corner.y);
            north = Math.max(north, corner.y);
        }
        int last = lastUpTo(north, rows);
        for (int row = firstFrom(south); row <= last; row++) {
            double y = (row + 0.5) * cell;
            double west = Double.POSITIVE_INFINITY;
            double east = Double.NEGATIVE_INFINITY;
            for (int i = 0; i < corners.length; i++) {
                Coordinate a = corners[i];
                Coordinate b = corners[(i + 1) % corners.length];
                if (Math.min(a.y, b.y) <= y && y <= Math.max(a.y, b.y)) {
                    double x = a.y == b.y ? a.x : at(y, a, b);
                    west = Math.min(west, Math.min(x, a.y == b.y ? b.x : x));
                    east = Math.max(east, Math.max(x, a.y == b.y ? b.x : x));
                }
            }
            run(row, firstFrom(west), lastUpTo(east, columns), out);
        }
    }

    private void run(int row, int from, int to, Words out) throws Exception {
        int end;
        for (int column = from; column <= to; column = end + 1) {
            end = Math.min(to, column | Long.SIZE - 1);
            int word = word(row, column);
            long bits = -1L << column & -1L >>> Long.SIZE - 1 - end % Long.SIZE & inside[word];
            if (bits != 0) {
                out.accept(word, bits);
            }
        }
    }

    /** The first cell whose center is not before a coordinate. */
    private int firstFrom(double meters) {
        return (int) Math.max(0, Math.ceil(meters / cell - 0.5));
    }

    private int lastUpTo(double meters, int all) {
        return (int) Math.min(all - 1, Math.floor(meters / cell - 0.5));
    }

    private static double at(double y, Coordinate a, Coordinate b) {
        return a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
    }

    /** Marks the cells of the field row by row: those between each odd crossing of the border and the next. */
    private void fill(Geometry area) {
        List<List<Double>> crossings = new ArrayList<>();
        for (int row = 0; row < rows; row++) {
            crossings.add(new ArrayList<>(2));
        }
        for (Object ring : LinearComponentExtracter.getLines(area)) {
            Coordinate[] corners = ((LineString) ring).getCoordinates();
            for (int i = 1; i < corners.length; i++) {
                cross(toMeters(corners[i - 1].x, corners[i - 1].y), toMeters(corners[i].x, corners[i].y), crossings);
            }
        }
        for (int row = 0; row < rows; row++) {
            double[] at = crossings.get(row).stream()
                    .mapToDouble(Double::doubleValue)
                    .sorted()
                    .toArray();
            for (int i = 1; i < at.length; i += 2) {
                int last = lastUpTo(at[i], columns);
                for (int column = firstFrom(at[i - 1]); column <= last; column++) {
                    inside[word(row, column)] |= 1L << column;
                }
            }
        }
    }

    private void cross(Coordinate a, Coordinate b, List<List<Double>> crossings) {
        int last = lastUpTo(Math.max(a.y, b.y), rows);
        for (int row = firstFrom(Math.min(a.y, b.y)); row <= last; row++) {
            double y = (row + 0.5) * cell;
            if (a.y <= y != b.y <= y) {
                crossings.get(row).add(at(y, a, b));
            }
        }
    }
}
