package io.furrow.control.rest.description;

import java.util.Comparator;
import java.util.Optional;
import java.util.Set;

/** Finds the known name that a misspelled one probably means. */
public final class NearestName {
    private static final int MAX_LENGTH = 64;
    /** One edit per so many characters. */
    private static final int CHARACTERS_PER_EDIT = 3;

    private NearestName() {}

    /** Returns a known name within one edit per three characters, at least one; empty if there is none. */
    public static Optional<String> of(String name, Set<String> known) {
        if (name.length() > MAX_LENGTH) {
            return Optional.empty();
        }
        int max = Math.max(1, name.length() / CHARACTERS_PER_EDIT);
        return known.stream()
                .filter(each -> distance(name, each) <= max)
                .min(Comparator.comparingInt(each -> distance(name, each)));
    }

    /**
     * The number of insertions, deletions, replacements and swaps of neighbors, without upper and lower case. Optimal
     * string alignment: G. Navarro, A guided tour to approximate string matching, 2001.
     */
    private static int distance(String one, String other) {
        String a = one.toLowerCase(java.util.Locale.ROOT);
        String b = other.toLowerCase(java.util.Locale.ROOT);
        int[][] edits = new int[a.length() + 1][b.length() + 1];
        for (int i = 0; i <= a.length(); i++) {
            for (int j = 0; j <= b.length(); j++) {
                if (i == 0 || j == 0) {
                    edits[i][j] = i + j;
                    continue;
                }
                boolean equal = a.charAt(i - 1) == b.charAt(j - 1);
                edits[i][j] =
                        Math.min(edits[i - 1][j - 1] + (equal ? 0 : 1), 1 + Math.min(edits[i - 1][j], edits[i][j - 1]));
                boolean swapped =
                        i > 1 && j > 1 && a.charAt(i - 1) == b.charAt(j - 2) && a.charAt(i - 2) == b.charAt(j - 1);
                if (swapped) {
                    edits[i][j] = Math.min(edits[i][j], edits[i - 2][j - 2] + 1);
                }
            }
        }
        return edits[a.length()][b.length()];
    }
}
