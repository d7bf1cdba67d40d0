package io.furrow.soak.devices;

import java.util.ArrayList;
import java.util.List;

/** Collects the results of checks, one line each; prints them at once and in a table at the end. */
public final class CheckResults {
    private static final int MAX_SHOWN = 8;

    private final List<String> lines = new ArrayList<>();
    private boolean holds = true;

    /**
     * Adds a line.
     *
     * @param what as in "averages of five fields"
     * @param figures counts and measurements
     * @param differences empty if the check succeeded
     */
    public void add(String what, String figures, List<String> differences) {
        holds &= differences.isEmpty();
        String line = "%-6s %-58s %s".formatted(differences.isEmpty() ? "holds" : "DIFFERS", what, figures);
        lines.add(line);
        System.out.println(line);
        differences.stream().limit(MAX_SHOWN).forEach(each -> System.out.println("         " + each));
        if (differences.size() > MAX_SHOWN) {
            System.out.println("         and %d more".formatted(differences.size() - MAX_SHOWN));
        }
    }

    public boolean hold() {
        return holds;
    }

    public List<String> lines() {
        return lines;
    }
}
