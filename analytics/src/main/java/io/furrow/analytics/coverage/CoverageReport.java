package io.furrow.analytics.coverage;

/**
 * The coverage of a field at an instant.
 *
 * @param last the newest swath, without its area
 * @param time epoch ms
 * @param begin of the first swath, epoch ms
 * @param cell side of a cell, meters
 * @param fieldCells number of cells of the field
 * @param covered number of cells that are covered
 * @param overlapped number of cells that are covered again
 * @param gaps number of cells in gaps; 0 for a single robot
 * @param perHour number of cells that are newly covered in an hour; NaN if unknown
 * @param layer the cells; null for a single robot, and if no cell is covered
 */
public record CoverageReport(
        Swath last,
        long time,
        long begin,
        double cell,
        long fieldCells,
        long covered,
        long overlapped,
        long gaps,
        double perHour,
        Layer layer) {
    private static final double SQUARE_METERS_PER_HECTARE = 10_000;
    private static final double MILLIS_PER_HOUR = 3_600_000;

    /**
     * The part of a field that has covered cells, as a raster.
     *
     * @param west longitude of its south-west corner, degrees
     * @param south latitude of its south-west corner, degrees
     * @param east longitude of its north-east corner, degrees
     * @param north latitude of its north-east corner, degrees
     * @param columns number of cells from west to east
     * @param rows number of cells from south to north
     * @param runs each a number, 4 × its length + its code: 0 not covered, 1 covered, 2 covered again, 3 gap; seven bits per byte, the
     *     lowest first, in as many bytes as it needs
     */
    public record Layer(double west, double south, double east, double north, int columns, int rows, byte[] runs) {}

    double hectares(double cells) {
        return cells * cell * cell / SQUARE_METERS_PER_HECTARE;
    }

    double share() {
        return fieldCells == 0 ? 0 : (double) covered / fieldCells;
    }

    /** Milliseconds until the field is covered at the rate; NaN if unknown. */
    double millisLeft() {
        return perHour > 0 ? (fieldCells - covered) / perHour * MILLIS_PER_HOUR : Double.NaN;
    }
}
