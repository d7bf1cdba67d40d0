package io.furrow.analytics.collision.matching;

import java.util.Arrays;
import java.util.List;

import io.furrow.analytics.collision.grid.Geodesy;
import io.furrow.analytics.position.PositionFix;

/**
 * An index of the devices of a grid cell, by name and by location: in squares of twice the threshold. The squares lie in the
 * plane of two of the three axes of the unit vectors, the two to which the first member's surroundings are flattest. Devices
 * that are close in space are close along every axis, so that none is missed anywhere on the sphere and no wrapping is
 * needed. The index consists of a few arrays, because at a million comparisons a second scattered memory is the bottleneck:
 * a member is a number, both lookups follow chains of numbers.
 */
final class CellIndex {
    /** Twice the rounding of a coordinate, in Earth radii: 6 nm. */
    private static final double GUARD = 1e-15;

    private static final int MIN = 8;
    private static final int NONE = -1;
    private static final long SPREAD = 0x9E3779B97F4A7C15L;

    private final double reach;
    private final double margin;
    private final double side;
    private Axes axes;
    private int size;

    private CellEntry[] members = new CellEntry[MIN];
    private double[] coordinates = new double[3 * MIN];
    private long[] squares = new long[MIN];
    private int[] names = new int[MIN];
    private int[] nextInSquare = new int[MIN];
    private int[] nextOfName = new int[MIN];
    private int[] firstInSquare = empty(2 * MIN);
    private int[] firstOfName = empty(2 * MIN);

    /** The two axes of the plane. */
    private enum Axes {
        YZ,
        XZ,
        XY
    }

    /** @param reach the greatest chord between two close members, in Earth radii */
    CellIndex(double reach) {
        this.reach = reach;
        margin = reach + GUARD;
        side = 2 * margin;
    }

    double reach() {
        return reach;
    }

    int size() {
        return size;
    }

    List<CellEntry> all() {
        return List.of(Arrays.copyOf(members, size));
    }

    /** Adds a device that is not a member. */
    void add(CellEntry cellEntry) {
        if (axes == null) {
            axes = flattest(cellEntry);
        }
        if (size == members.length) {
            grow();
        }
        set(size++, cellEntry, square(index(u(cellEntry)), index(v(cellEntry))));
    }

    /** Removes a device; null if it is not a member. */
    CellEntry remove(PositionFix device) {
        int name = device.identity().hashCode();
        int number = firstOfName[slot(name, firstOfName)];
        while (number != NONE
                && (names[number] != name || !members[number].fix().isOfSameDevice(device))) {
            number = nextOfName[number];
        }
        if (number == NONE) {
            return null;
        }
        CellEntry removed = members[number];
        unlink(number);
        size--;
        if (number != size) { // the last takes its number
            CellEntry last = members[size];
            unlink(size);
            set(number, last, squares[size]);
        }
        members[size] = null;
        return removed;
    }

    /** Adds all other devices close to a member to {@code near}, also halo copies close to a halo copy. */
    void near(CellEntry cellEntry, Proximity proximity, List<CellEntry> near) {
        find(cellEntry, proximity, false, near);
    }

    /** Adds all devices with which a member has an encounter to {@code partners}; in a crowd, few of the close ones. */
    void partners(CellEntry cellEntry, Proximity proximity, List<CellEntry> partners) {
        find(cellEntry, proximity, true, partners);
    }

    private void find(CellEntry cellEntry, Proximity proximity, boolean followed, List<CellEntry> found) {
        if (size == 0) {
            return;
        }
        double u = u(cellEntry);
        double v = v(cellEntry);
        int lastU = index(u + margin);
        int lastV = index(v + margin);
        for (int i = index(u - margin); i <= lastU; i++) {
            for (int j = index(v - margin); j <= lastV; j++) {
                find(cellEntry, square(i, j), proximity, followed, found);
            }
        }
    }

    private void find(CellEntry cellEntry, long square, Proximity proximity, boolean followed, List<CellEntry> found) {
        double limit = reach * reach;
        for (int n = firstInSquare[slot(square, firstInSquare)]; n != NONE; n = nextInSquare[n]) {
            if (squares[n] == square
                    && Geodesy.square(cellEntry.x() - coordinates[3 * n])
                                    + Geodesy.square(cellEntry.y() - coordinates[3 * n + 1])
                                    + Geodesy.square(cellEntry.z() - coordinates[3 * n + 2])
                            <= limit
                    && (!followed
                            || PairSelection.meet(cellEntry, members[n])
                                    && PairSelection.follows(cellEntry, members[n]))
                    && proximity.near(cellEntry, members[n])
                    && members[n] != cellEntry) {
                found.add(members[n]);
            }
        }
    }

    private void set(int number, CellEntry cellEntry, long square) {
        members[number] = cellEntry;
        coordinates[3 * number] = cellEntry.x();
        coordinates[3 * number + 1] = cellEntry.y();
        coordinates[3 * number + 2] = cellEntry.z();
        squares[number] = square;
        names[number] = cellEntry.fix().identity().hashCode();
        link(number);
    }

    private void link(int number) {
        int inSquare = slot(squares[number], firstInSquare);
        nextInSquare[number] = firstInSquare[inSquare];
        firstInSquare[inSquare] = number;
        int ofName = slot(names[number], firstOfName);
        nextOfName[number] = firstOfName[ofName];
        firstOfName[ofName] = number;
    }

    private void unlink(int number) {
        unlink(number, slot(squares[number], firstInSquare), firstInSquare, nextInSquare);
        unlink(number, slot(names[number], firstOfName), firstOfName, nextOfName);
    }

    private static void unlink(int number, int slot, int[] first, int[] next) {
        if (first[slot] == number) {
            first[slot] = next[number];
            return;
        }
        int before = first[slot];
        while (next[before] != number) {
            before = next[before];
        }
        next[before] = next[number];
    }

    private void grow() {
        int capacity = 2 * members.length;
        members = Arrays.copyOf(members, capacity);
        coordinates = Arrays.copyOf(coordinates, 3 * capacity);
        squares = Arrays.copyOf(squares, capacity);
        names = Arrays.copyOf(names, capacity);
        nextInSquare = new int[capacity];
        nextOfName = new int[capacity];
        firstInSquare = empty(2 * capacity);
        firstOfName = empty(2 * capacity);
        for (int number = 0; number < size; number++) {
            link(number);
        }
    }

    private static int[] empty(int slots) {
        int[] empty = new int[slots];
        Arrays.fill(empty, NONE);
        return empty;
    }

    private static Axes flattest(CellEntry cellEntry) {
        double x = Math.abs(cellEntry.x());
        double y = Math.abs(cellEntry.y());
        double z = Math.abs(cellEntry.z());
        return x >= y && x >= z ? Axes.YZ : y >= z ? Axes.XZ : Axes.XY;
    }

    private double u(CellEntry cellEntry) {
        return axes == Axes.YZ ? cellEntry.y() : cellEntry.x();
    }

    private double v(CellEntry cellEntry) {
        return axes == Axes.XY ? cellEntry.y() : cellEntry.z();
    }

    private int index(double coordinate) {
        return (int) Math.floor(coordinate / side);
    }

    private static long square(int i, int j) {
        return (long) i << Integer.SIZE | j & 0xFFFF_FFFFL;
    }

    private static int slot(long number, int[] slots) {
        long spread = number * SPREAD;
        return (int) (spread >>> 40) & slots.length - 1;
    }
}
