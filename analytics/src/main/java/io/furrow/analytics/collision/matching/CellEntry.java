package io.furrow.analytics.collision.matching;

import java.util.Objects;

import io.furrow.analytics.position.PositionFix;

/** A device in a grid cell, at one of its positions. */
public final class CellEntry {
    private final PositionFix fix;
    private final boolean resident;
    private final double x;
    private final double y;
    private final double z;

    /** The {@link NearestNeighbors#bit} of its identity. */
    private final long bit;

    /** Null if it follows all close devices. */
    private NearestNeighbors nearestNeighbors;
    /** Bits of the shortlist; stored here because they are read much more often than the rest of it. */
    private long listed;
    /** The change of the current instant that added it; null for an older member. */
    private CellChange cellChange;
    /** The change being compared, if this member is a former partner not yet met again. */
    private CellChange partnerOf;

    /** @param resident whether the cell is its home; else it is a halo copy */
    private CellEntry(PositionFix fix, boolean resident, double x, double y, double z) {
        this.fix = fix;
        this.resident = resident;
        this.x = x;
        this.y = y;
        this.z = z;
        this.bit = NearestNeighbors.bit(fix.identity());
    }

    public static CellEntry of(PositionFix fix, boolean resident) {
        double phi = Math.toRadians(fix.latitude());
        double lambda = Math.toRadians(fix.longitude());
        double cosine = Math.cos(phi);
        return new CellEntry(fix, resident, cosine * Math.cos(lambda), cosine * Math.sin(lambda), Math.sin(phi));
    }

    /** An equal entry for another cell; changes of one do not affect the other. */
    CellEntry copy() {
        CellEntry copy = new CellEntry(fix, resident, x, y, z);
        copy.shortlist(nearestNeighbors);
        return copy;
    }

    PositionFix fix() {
        return fix;
    }

    boolean resident() {
        return resident;
    }

    /** Component of the unit vector from the Earth's center to it, towards 0° N 0° E. */
    double x() {
        return x;
    }

    /** Component towards 0° N 90° E. */
    double y() {
        return y;
    }

    /** Component towards the north pole. */
    double z() {
        return z;
    }

    NearestNeighbors shortlist() {
        return nearestNeighbors;
    }

    /** May only be called during the instant that adds it. */
    void shortlist(NearestNeighbors now) {
        nearestNeighbors = now;
        listed = now == null ? 0 : now.bits();
    }

    /** Whether the other is on its shortlist. */
    boolean lists(CellEntry other) {
        return (listed & other.bit) != 0 && nearestNeighbors.has(other.fix);
    }

    CellChange change() {
        return cellChange;
    }

    void change(CellChange now) {
        cellChange = now;
    }

    CellChange partnerOf() {
        return partnerOf;
    }

    void partnerOf(CellChange now) {
        partnerOf = now;
    }

    /** Equality of what is serialized: device, position, residence, followed devices. */
    @Override
    public boolean equals(Object other) {
        return other instanceof CellEntry cellEntry
                && resident == cellEntry.resident
                && fix.equals(cellEntry.fix)
                && Objects.equals(nearestNeighbors, cellEntry.nearestNeighbors);
    }

    @Override
    public int hashCode() {
        return fix.hashCode();
    }

    @Override
    public String toString() {
        return (resident ? "resident " : "halo copy ") + fix;
    }
}
