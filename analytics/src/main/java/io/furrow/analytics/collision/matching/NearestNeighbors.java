package io.furrow.analytics.collision.matching;

import java.util.List;

import io.furrow.analytics.position.PositionFix;

/** The devices of its topic with which a device of a crowd has encounters, as of its newest report. */
final class NearestNeighbors {
    private static final int SPREAD = 0x9E3779B9;
    /** Slots per identity: lookups nearly always miss, and should then hit an empty slot. */
    private static final int ROOM = 8;

    private final List<String> identities;
    /** The sum of their {@link #bit}s. */
    private final long bits;

    private final String[] slots;
    private final int shift;

    /** @param identities of the devices, distinct */
    NearestNeighbors(List<String> identities) {
        this.identities = List.copyOf(identities);
        shift = Integer.numberOfLeadingZeros(ROOM * Math.max(1, identities.size()));
        slots = new String[1 << Integer.SIZE - shift];
        long sum = 0;
        for (String identity : identities) {
            slots[slot(identity)] = identity;
            sum |= bit(identity);
        }
        bits = sum;
    }

    List<String> identities() {
        return identities;
    }

    /** One of 64 bits, which rules out most devices that are not on a list. */
    static long bit(String identity) {
        return 1L << (identity.hashCode() * SPREAD >>> Integer.SIZE - 6);
    }

    long bits() {
        return bits;
    }

    boolean has(PositionFix device) {
        return slots[slot(device.identity())] != null;
    }

    /** The slot of an identity, or the free one for it. */
    private int slot(String identity) {
        int slot = identity.hashCode() * SPREAD >>> shift;
        while (slots[slot] != null && !slots[slot].equals(identity)) {
            slot = slot + 1 & slots.length - 1;
        }
        return slot;
    }

    @Override
    public boolean equals(Object other) {
        return other instanceof NearestNeighbors list && identities.equals(list.identities);
    }

    @Override
    public int hashCode() {
        return identities.hashCode();
    }

    @Override
    public String toString() {
        return identities.toString();
    }
}
