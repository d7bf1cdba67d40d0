package io.furrow.analytics.collision;

import java.util.Arrays;
import java.util.Collection;
import java.util.List;

/**
 * Who may be near whom in a cell: its members in squares of twice the threshold. The squares lie in the plane of two of the
 * three axes in which unit vectors are told, the two that the first member's surroundings are flattest to. Who is close in
 * space is close along every axis, so nothing is missed anywhere on the sphere, and nothing has to be wrapped around.
 */
final class FineGrid {
    /** Twice the rounding of a coordinate, in Earth radii: 6 nm. */
    private static final double GUARD = 1e-15;

    private static final int LEAST_SLOTS = 16;
    private static final long SPREAD = 0x9E3779B97F4A7C15L;

    private final double reach;
    private final double margin;
    private final double side;
    private Axes axes;
    private Entry[] slots = new Entry[LEAST_SLOTS];
    private int size;

    /** The two axes of the plane. */
    private enum Axes {
        YZ,
        XZ,
        XY
    }

    /** A member in the chain of its slot. */
    private static final class Entry {
        private final long square;
        private final Member member;
        private Entry next;

        private Entry(long square, Member member, Entry next) {
            this.square = square;
            this.member = member;
            this.next = next;
        }
    }

    /** @param reach the greatest chord between two close members, in Earth radii */
    FineGrid(double reach, Collection<Member> members) {
        this.reach = reach;
        margin = reach + GUARD;
        side = 2 * margin;
        members.forEach(this::add);
    }

    double reach() {
        return reach;
    }

    void add(Member member) {
        if (axes == null) {
            axes = flattest(member);
        }
        if (size == slots.length) {
            grow();
        }
        long square = square(index(u(member)), index(v(member)));
        int slot = slot(square, slots.length);
        slots[slot] = new Entry(square, member, slots[slot]);
        size++;
    }

    /** Takes out the very member that was added. */
    void remove(Member member) {
        int slot = slot(square(index(u(member)), index(v(member))), slots.length);
        Entry before = null;
        Entry entry = slots[slot];
        while (entry.member != member) {
            before = entry;
            entry = entry.next;
        }
        if (before == null) {
            slots[slot] = entry.next;
        } else {
            before.next = entry.next;
        }
        size--;
    }

    /** Adds all to {@code close} that are close to a member, who is not in the grid itself. */
    void closeTo(Member member, Proximity proximity, List<Member> close) {
        if (size == 0) {
            return;
        }
        double u = u(member);
        double v = v(member);
        int lastU = index(u + margin);
        int lastV = index(v + margin);
        for (int i = index(u - margin); i <= lastU; i++) {
            for (int j = index(v - margin); j <= lastV; j++) {
                long square = square(i, j);
                for (Entry entry = slots[slot(square, slots.length)]; entry != null; entry = entry.next) {
                    if (entry.square == square && proximity.holds(member, entry.member)) {
                        close.add(entry.member);
                    }
                }
            }
        }
    }

    private void grow() {
        Entry[] old = slots;
        slots = new Entry[2 * old.length];
        Arrays.stream(old).forEach(this::move);
    }

    private void move(Entry chain) {
        Entry entry = chain;
        while (entry != null) {
            Entry next = entry.next;
            int slot = slot(entry.square, slots.length);
            entry.next = slots[slot];
            slots[slot] = entry;
            entry = next;
        }
    }

    private static Axes flattest(Member member) {
        double x = Math.abs(member.x());
        double y = Math.abs(member.y());
        double z = Math.abs(member.z());
        return x >= y && x >= z ? Axes.YZ : y >= z ? Axes.XZ : Axes.XY;
    }

    private double u(Member member) {
        return axes == Axes.YZ ? member.y() : member.x();
    }

    private double v(Member member) {
        return axes == Axes.XY ? member.y() : member.z();
    }

    private int index(double coordinate) {
        return (int) Math.floor(coordinate / side);
    }

    private static long square(int i, int j) {
        return (long) i << Integer.SIZE | j & 0xFFFF_FFFFL;
    }

    private static int slot(long square, int slots) {
        long spread = square * SPREAD;
        return (int) (spread >>> 40) & slots - 1;
    }
}
