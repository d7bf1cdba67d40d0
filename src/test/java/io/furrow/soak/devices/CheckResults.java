package io.furrow.soak.devices;

import java.util.ArrayList;
import java.util.List;

/** What was checked and whether it holds: a line each, said at once and in a table at the end. */
public final class CheckResults {
    private static final int SHOWN = 8;

    private final List<String> lines = new ArrayList<>();
    private boolean holds = true;

    /**
     * Adds a line.
     *
     * @param what as in "averages of five fields"
     * @param figures what was counted or measured
     * @param differences empty where it holds
     */
    public void add(String what, String figures, List<String> differences) {
        holds &= differences.isEmpty();
        String line = "%-6s %-58s %s".formatted(differences.isEmpty() ? "holds" : "DIFFERS", what, figures);
        lines.add(line);
        System.out.println(line);
        differences.stream().limit(SHOWN).forEach(each -> System.out.println("         " + each));
        if (differences.size() > SHOWN) {
            System.out.println("         and %d more".formatted(differences.size() - SHOWN));
        }
    }

    public boolean hold() {
        return holds;
    }

    public List<String> lines() {
        return lines;
    }
}
