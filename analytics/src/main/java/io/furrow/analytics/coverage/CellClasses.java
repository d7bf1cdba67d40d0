package io.furrow.analytics.coverage;

import java.io.ByteArrayOutputStream;
import java.util.Arrays;

import org.locationtech.jts.geom.Coordinate;

import io.furrow.analytics.coverage.CoverageReport.Layer;

/**
 * Which cells of a field are covered, overlapped or in a gap, at an instant. A gap is a row of cells of the field from west to east or
 * south to north that are not covered, between two covered ones that are near each other.
 */
final class CellClasses {
    /** Codes of the cells in a {@link Layer}; all others are 0. */
    private static final int COVERED = 1;

    private static final int OVERLAPPED = 2;
    private static final int GAP = 3;
    /** Before all rows and columns. */
    private static final int FAR = Integer.MIN_VALUE / 2;

    private static final int CODE_BITS = 2;
    /** A byte of a number has seven bits of it, the lowest first, and one that is set if another follows. */
    private static final int BYTE_BITS = 7;

    private final FieldGrid grid;
    private final long[] covered;
    private final long[] overlapped;
    private final long[] gaps;
    /** The rows and columns of the tiles that have covered cells; the last ones are exclusive. */
    private int south = Integer.MAX_VALUE;

    private int west = Integer.MAX_VALUE;
    private int north;
    private int east;

    CellClasses(FieldGrid grid) {
        this.grid = grid;
        covered = new long[grid.tiles() * FieldGrid.TILE];
        overlapped = new long[covered.length];
        gaps = new long[covered.length];
    }

    /** @param at first of the words with overlapped cells; those with covered cells come first */
    void take(int tile, long[] words, int at) {
        System.arraycopy(words, 0, covered, tile * FieldGrid.TILE, FieldGrid.TILE);
        System.arraycopy(words, at, overlapped, tile * FieldGrid.TILE, FieldGrid.TILE);
        south = Math.min(south, grid.rowOf(tile));
        west = Math.min(west, grid.columnOf(tile));
        north = Math.max(north, Math.min(grid.rows(), grid.rowOf(tile) + FieldGrid.TILE));
        east = Math.max(east, Math.min(grid.columns(), grid.columnOf(tile) + Long.SIZE));
    }

    /** @param most number of cells between the two covered ones */
    void findGaps(int most) {
        int[] lastRow = new int[grid.columns()];
        Arrays.fill(lastRow, FAR);
        for (int row = south; row < north; row++) {
            int lastColumn = FAR;
            for (int first = west; first < east; first += Long.SIZE) {
                for (long bits = covered[grid.word(row, first)]; bits != 0; bits &= bits - 1) {
                    int column = first + Long.numberOfTrailingZeros(bits);
                    for (int gap = lastColumn + 1; column - lastColumn - 1 <= most && gap < column; gap++) {
                        markGap(row, gap);
                    }
                    for (int gap = lastRow[column] + 1; row - lastRow[column] - 1 <= most && gap < row; gap++) {
                        markGap(gap, column);
                    }
                    lastColumn = column;
                    lastRow[column] = row;
                }
            }
        }
    }

    private void markGap(int row, int column) {
        int word = grid.word(row, column);
        gaps[word] |= 1L << column & grid.inside(word);
    }

    private boolean is(long[] marks, int row, int column) {
        return (marks[grid.word(row, column)] >>> column & 1) != 0;
    }

    /** Number of cells in gaps. */
    int gaps() {
        return Arrays.stream(gaps).mapToInt(Long::bitCount).sum();
    }

    /** 0 not covered, 1 covered, 2 overlapped, 3 gap. */
    int code(int row, int column) {
        if (is(overlapped, row, column)) {
            return OVERLAPPED;
        }
        if (is(covered, row, column)) {
            return COVERED;
        }
        return is(gaps, row, column) ? GAP : 0;
    }

    /**
     * The tiles with covered cells as a raster of at most so many cells: every n-th cell of every n-th row, from the middle of the n. Null
     * if no cell is covered: a robot may have worked less than a cell.
     */
    Layer layer(int most) {
        if (south >= north) {
            return null;
        }
        int n = (int) Math.max(1, Math.ceil(Math.sqrt((double) (north - south) * (east - west) / most)));
        int columns = count(east - west, n);
        int rows = count(north - south, n);
        Coordinate one = grid.degreesOfCell();
        double westOf = grid.box().getMinX() + west * one.x;
        double southOf = grid.box().getMinY() + south * one.y;
        return new Layer(
                westOf, southOf, westOf + columns * n * one.x, southOf + rows * n * one.y, columns, rows, runs(n));
    }

    /** Number of indexes n/2, n/2 + n, ... below all. */
    private static int count(int all, int n) {
        return (all - n / 2 + n - 1) / n;
    }

    /** From the south-west corner to the east, then to the north, run by run: each a number, 4 × its length + its code. */
    private byte[] runs(int n) {
        ByteArrayOutputStream out = new ByteArrayOutputStream();
        int code = 0;
        int length = 0;
        for (int row = south + n / 2; row < north; row += n) {
            for (int column = west + n / 2; column < east; column += n) {
                int next = code(row, column);
                if (next != code) {
                    write(length << CODE_BITS | code, out);
                    code = next;
                    length = 0;
                }
                length++;
            }
        }
        write(length << CODE_BITS | code, out);
        return out.toByteArray();
    }

    private static void write(int number, ByteArrayOutputStream out) {
        int rest = number;
        while (rest >>> BYTE_BITS != 0) {
            out.write(rest | 1 << BYTE_BITS);
            rest >>>= BYTE_BITS;
        }
        out.write(rest);
    }
}
