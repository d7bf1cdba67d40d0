package io.furrow.analytics.coverage;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.locationtech.jts.geom.Coordinate;

/**
 * Marks the cells of swaths. A cell that is covered is overlapped when another swath covers it, except one that its robot has just
 * driven: the last working width of a way without interruption, of which the parts always meet.
 *
 * <p>Each tile has three words per row: covered cells, those of swaths that are not recent any more, overlapped cells.
 */
final class CoveredCells {
    /** Words of a tile with all three kinds. */
    private static final int WORDS = 3 * FieldGrid.TILE;

    private static final int PASSED = FieldGrid.TILE;
    private static final int OVERLAPPED = 2 * FieldGrid.TILE;
    /** Maximum number of recent swaths of a robot. */
    private static final int MAX_RECENT = 256;

    private final FieldGrid grid;
    private final Tiles tiles;

    /** Stores tiles by number. */
    interface Tiles {
        /** Returns null if the tile was never written. */
        long[] read(int tile) throws Exception;

        void write(int tile, long[] words) throws Exception;
    }

    /** Changes the words of a tile. */
    private interface Change {
        void apply(long[] words, int row, long bits);
    }

    /** The number of cells that a swath covers or overlaps, which were not before, and the swaths that are recent with it. */
    record Added(long covered, long overlapped, List<Swath> recent) {}

    CoveredCells(FieldGrid grid, Tiles tiles) {
        this.grid = grid;
        this.tiles = tiles;
    }

    /** @param recent the result of the last call; swaths of a robot in the order of their times */
    Added add(Swath swath, List<Swath> recent) throws Exception {
        List<Swath> kept = new ArrayList<>();
        Map<Integer, Long> others = new HashMap<>();
        int own = (int) recent.stream().filter(swath::isOfSameRobot).count();
        for (Swath earlier : recent) {
            if (!earlier.isOfSameRobot(swath)) {
                kept.add(earlier);
                if (earlier.isNear(swath)) {
                    cells(earlier, (word, bits) -> others.merge(word, bits, (a, b) -> a | b));
                }
            } else if (swath.isJustAfter(earlier) && own <= MAX_RECENT) {
                kept.add(earlier);
            } else {
                own--;
                pass(earlier);
            }
        }
        kept.add(swath.withoutArea());
        long[] found = new long[2];
        change(swath, (words, row, bits) -> {
            long again = bits & words[PASSED + row] & ~words[OVERLAPPED + row];
            found[0] += Long.bitCount(bits & ~words[row]);
            found[1] += Long.bitCount(again);
            words[row] |= bits;
            words[OVERLAPPED + row] |= again;
        });
        found[1] += overlapOthers(swath, others);
        return new Added(found[0], found[1], kept);
    }

    private long overlapOthers(Swath swath, Map<Integer, Long> others) throws Exception {
        if (others.isEmpty()) {
            return 0;
        }
        Map<Integer, Long> both = new HashMap<>();
        cells(swath, (word, bits) -> {
            long shared = bits & others.getOrDefault(word, 0L);
            if (shared != 0) {
                both.merge(word, shared, (a, b) -> a | b);
            }
        });
        long found = 0;
        for (Map.Entry<Integer, Long> each : both.entrySet()) {
            int row = each.getKey() % FieldGrid.TILE;
            long[] words = tiles.read(each.getKey() / FieldGrid.TILE);
            long again = each.getValue() & ~words[OVERLAPPED + row];
            found += Long.bitCount(again);
            words[OVERLAPPED + row] |= again;
            tiles.write(each.getKey() / FieldGrid.TILE, words);
        }
        return found;
    }

    /** Returns the recent swaths without those of robots that drove none after an instant, which cannot be continued any more. */
    List<Swath> passBefore(long time, List<Swath> recent) throws Exception {
        Map<String, Long> newest = new HashMap<>();
        recent.forEach(swath -> newest.merge(swath.robot(), swath.time(), Math::max));
        List<Swath> kept = new ArrayList<>();
        for (Swath swath : recent) {
            if (newest.get(swath.robot()) < time) {
                pass(swath);
            } else {
                kept.add(swath);
            }
        }
        return kept;
    }

    private void pass(Swath swath) throws Exception {
        change(swath, (words, row, bits) -> words[PASSED + row] |= bits);
    }

    private void change(Swath swath, Change change) throws Exception {
        cells(swath, (word, bits) -> {
            int tile = word / FieldGrid.TILE;
            long[] known = tiles.read(tile);
            long[] words = known == null ? new long[WORDS] : known;
            change.apply(words, word % FieldGrid.TILE, bits);
            tiles.write(tile, words);
        });
    }

    private void cells(Swath swath, FieldGrid.Words out) throws Exception {
        for (Coordinate[] part : swath.outline(grid)) {
            grid.cellsIn(part, out);
        }
    }

    /** The class of each cell, with the gaps between covered cells that are at most so many meters apart. */
    CellClasses classes(double maxGap) throws Exception {
        CellClasses classes = new CellClasses(grid);
        for (int tile = 0; tile < grid.tiles(); tile++) {
            long[] words = tiles.read(tile);
            if (words != null) {
                classes.take(tile, words, OVERLAPPED);
            }
        }
        classes.findGaps((int) Math.ceil(maxGap / grid.cell()));
        return classes;
    }
}
