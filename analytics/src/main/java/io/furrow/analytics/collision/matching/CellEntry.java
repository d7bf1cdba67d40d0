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

    /** Of its identity: {@link NearestNeighbors#bit}. */
    private final long bit;

    /** Null if it follows all that are close. */
    private NearestNeighbors nearestNeighbors;
    /** Of the shortlist; here because it is looked at much more often than that. */
    private long listed;
    /** What brought it here at the instant that is being applied; null for a member that was here before. */
    private CellChange cellChange;
    /** The change that is being compared, where this member is a partner of before that has not been met again. */
    private CellChange partnerOf;

    /** @param resident whether it stands in the cell; else the cell has a halo copy of it */
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

    /** The same, for another cell: what a change leaves in one does not show in the other. */
    CellEntry copy() {
        CellEntry copy = new CellEntry(fix, resident, x, y, z);
        copy.shortlist(nearestNeighbors);
        return copy;
    }

    /** Where it is. */
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

    /** Only before the instant at which it comes is over. */
    void shortlist(NearestNeighbors now) {
        nearestNeighbors = now;
        listed = now == null ? 0 : now.bits();
    }

    /** Whether it has a shortlist and the other is on it. */
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

    /** As it is written: the device, where it is, whether it stands in the cell, whom it follows. */
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
