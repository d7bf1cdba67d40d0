package io.furrow.launcher.status;

import java.util.ArrayList;
import java.util.List;

/**
 * What the live status says, in the order in which it is wanted: of what has no room the end is left out, and it says how much.
 *
 * @param results averages of fields
 * @param collisions the newest first
 * @param notices a sentence for each thing that waits for somebody
 * @param jobs a line each
 * @param topics a line for each that moves, the fastest first
 * @param idle how many other topics there are
 * @param addresses where everything is, first the page
 */
record StatusBlock(
        List<String> results,
        List<String> collisions,
        List<String> notices,
        List<String> jobs,
        List<String> topics,
        int idle,
        List<String> addresses) {
    /** As of old terminals; results leave the other half of that to jobs and topics. */
    private static final int FEW = 24;

    private static final int SHARES = 4;

    /** All of it. */
    List<String> lines() {
        return lines(Integer.MAX_VALUE);
    }

    /** @param rows how many lines there may be */
    List<String> lines(int rows) {
        List<String> lines = new ArrayList<>();
        int share = Math.max(rows, FEW) / SHARES;
        addresses.stream()
                .limit(Math.min(1, rows))
                .map(page -> page + "   Ctrl-C stops Furrow")
                .forEach(lines::add);
        add(lines, "", notices, 0, share, rows);
        add(lines, "averages", results, 0, share, rows);
        add(lines, "collisions", collisions, 0, share, rows);
        add(lines, "%-52s %10s".formatted("job", "to read"), jobs, 0, rows, rows);
        add(lines, "%-52s %10s %12s".formatted("topic", "per second", "total"), topics, idle, rows, rows);
        if (addresses.size() < rows - lines.size()) {
            add(lines, "addresses", addresses, 0, rows, rows);
        }
        return lines;
    }

    /** @param unsaid how many there are beside the members */
    private static void add(List<String> lines, String title, List<String> members, int unsaid, int share, int rows) {
        int room = Math.min(share, rows - lines.size()) - (title.isEmpty() ? 0 : 1);
        if (room <= 0 || members.isEmpty() && unsaid == 0) {
            return;
        }
        if (!title.isEmpty()) {
            lines.add(title);
        }
        int shown = members.size() + (unsaid > 0 ? 1 : 0) <= room ? members.size() : room - 1;
        members.stream().limit(shown).map(member -> "  " + member).forEach(lines::add);
        int more = members.size() - shown + unsaid;
        if (more > 0) {
            lines.add("  … and %d more".formatted(more));
        }
    }
}
