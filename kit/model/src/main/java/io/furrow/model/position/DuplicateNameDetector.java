package io.furrow.model.position;

import java.util.Arrays;
import java.util.HashSet;
import java.util.Set;

import io.furrow.model.ngsi.NgsiJson;

/**
 * Detects duplicate names in the open objects of a document. Reusable for several documents; allocates memory only for
 * objects with many members.
 */
final class DuplicateNameDetector {
    /** Up to this many members a linear search is cheaper than a set. */
    private static final int FEW = 32;

    private static final int DEPTHS = NgsiJson.MAX_NESTING + 2;

    private final int[] starts = new int[DEPTHS];
    /** One bit per name, by its hash: a name with a new bit is new. */
    private final long[] bits = new long[DEPTHS];

    private final Set<?>[] many = new Set<?>[DEPTHS];
    private String[] names = new String[4 * FEW];
    private int count;
    private int depth;

    /** Clears all names for the next document. */
    void clear() {
        Arrays.fill(many, null);
        count = 0;
        depth = 0;
    }

    void openObject() {
        depth++;
        starts[depth] = count;
        bits[depth] = 0;
        many[depth] = null;
    }

    void closeObject() {
        count = starts[depth];
        depth--;
    }

    /** Adds a name to the innermost object; returns false if it is a duplicate. */
    boolean add(String name) {
        long bit = 1L << (name.hashCode() * 0x9E3779B9 >>> 26);
        if ((bits[depth] & bit) != 0 && contains(name)) {
            return false;
        }
        bits[depth] |= bit;
        if (count - starts[depth] >= FEW) {
            return addToMany(name);
        }
        if (count == names.length) {
            names = Arrays.copyOf(names, 2 * count);
        }
        names[count++] = name;
        return true;
    }

    private boolean contains(String name) {
        for (int i = starts[depth]; i < count; i++) {
            if (names[i].equals(name)) {
                return true;
            }
        }
        return false;
    }

    @SuppressWarnings("unchecked")
    private boolean addToMany(String name) {
        if (many[depth] == null) {
            many[depth] = new HashSet<String>();
        }
        return ((Set<String>) many[depth]).add(name);
    }
}
