package io.furrow.model.position;

import java.util.Arrays;
import java.util.HashSet;
import java.util.Set;

import io.furrow.model.ngsi.NgsiJson;

/**
 * The names seen so far in the objects of a document that are open, so that a name that comes twice shows. Kept from document
 * to document; takes no memory of its own but for objects with many members.
 */
final class DuplicateNameDetector {
    /** Up to this many members a look at each costs less than a set. */
    private static final int FEW = 32;

    private static final int DEPTHS = NgsiJson.MAX_NESTING + 2;

    private final int[] starts = new int[DEPTHS];
    /** One bit per name, by its hash: while a bit is new, so is the name. */
    private final long[] bits = new long[DEPTHS];

    private final Set<?>[] many = new Set<?>[DEPTHS];
    private String[] names = new String[4 * FEW];
    private int count;
    private int depth;

    /** Forgets everything, for the next document. */
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

    /** Whether the innermost object has no such name yet; it has from now on. */
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
